# Written by python -m assets.generate; do not edit.
from . import srv as srv
