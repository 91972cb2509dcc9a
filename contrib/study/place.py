"""Directories that are written into: made, or refused in a sentence, and held by one study at a time."""
import contextlib
import fcntl
import os

from results import ResultError

LOCK = "study.lock"


def folder(directory):
    """The directory, which is made if it is missing."""
    try:
        os.makedirs(directory or ".", exist_ok=True)
    except FileExistsError:
        raise ResultError(f"nothing can be written into '{directory}': this is a file, no directory") from None
    except OSError as error:
        raise ResultError(f"nothing can be written into '{directory}': {error.strerror}") from None
    if not os.access(directory or ".", os.W_OK):
        raise ResultError(f"nothing can be written into '{directory}': permission denied")
    return directory


@contextlib.contextmanager
def held(directory):
    """Nobody else has the directory meanwhile. The system takes the lock from whoever ends, however he ends."""
    path = os.path.join(folder(directory), LOCK)
    try:
        file = open(path, "w", encoding="utf-8")
    except OSError as error:
        raise ResultError(f"nothing can be written into '{directory}': {error.strerror}") from None
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ResultError(f"another study is running in '{directory}': wait for its end, or name another directory with "
                              "--output") from None
        yield
