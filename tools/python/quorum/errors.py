"""What goes wrong, as an exception."""

import enum


class ErrorKind(enum.IntEnum):
    """Kinds of failure. The value is the exit code of the program `quorum` for it."""

    DEVICE = 1  #: a device or the system failed
    USAGE = 2  #: an option or an argument is wrong
    INPUT = 3  #: a file or an array is bad, or a file can't be written
    NO_DEVICE = 4  #: there is no such device
    MEMORY = 5  #: out of memory or threads, or a budget that is too small
    STOPPED = 143  #: should_stop asked to stop


class Error(Exception):
    """A failure: `kind` is an ErrorKind, `message` one line with the place, what is wrong, and the remedy."""

    def __init__(self, kind, message):
        super().__init__(kind, message)
        self.kind = ErrorKind(kind)
        self.message = message

    def __str__(self):
        return self.message
