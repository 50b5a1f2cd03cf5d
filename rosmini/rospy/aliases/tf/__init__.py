"""The module that scripts import as ``tf`` (http://wiki.ros.org/tf): the first API of transforms, with lists instead of messages."""

from __future__ import annotations

from rosmini.msgs.tf import msg, srv
from rosmini.tf import transformations
from rosmini.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
)

from . import broadcaster, listener
from .broadcaster import TransformBroadcaster
from .listener import Transformer, TransformerROS, TransformListener

Exception = TransformException

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "broadcaster",
    "listener",
    "msg",
    "srv",
    "transformations",
]
