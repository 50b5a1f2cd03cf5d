# Written by python -m rosmini.msgs.stubs; do not edit.
from . import msg as msg
