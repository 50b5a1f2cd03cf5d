# Written by python -m assets.generate; do not edit.
from . import msg as msg
