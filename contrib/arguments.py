"""Kinds of arguments of the scripts; argparse says what is wrong with them, with exit status 2."""
import argparse
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
INSTALLED = os.path.join(HERE, "..", "..", "..", "bin", "stockwork")  # beside share/stockwork/contrib
PROGRAM = os.path.join(HERE, "..", "build", "source", "stockwork")
if os.path.exists(INSTALLED) and not os.path.exists(PROGRAM):
    PROGRAM = INSTALLED


def program(path):
    """The absolute path of a program that can be run."""
    path = os.path.abspath(path)
    if not os.path.isfile(path) or not os.access(path, os.X_OK):
        raise argparse.ArgumentTypeError(f"there is no program '{path}'; build it, or name another by --program")
    return path


def whole_from(least):
    def whole(text):
        if int(text) < least:
            raise argparse.ArgumentTypeError(f"{text} is less than {least}")
        return int(text)
    return whole


def positive(text):
    value = float(text)
    if not 0. < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not greater than zero and finite")
    return value


def not_negative(text):
    value = float(text)
    if not 0. <= value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is less than zero, or not finite")
    return value


not_negative.__name__ = "number from 0 on"  # for what argparse says of a word


def window(text):
    """x0,x1,y0,y1"""
    try:
        x0, x1, y0, y1 = (float(x) for x in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not four numbers x0,x1,y0,y1") from None
    if not (x0 < x1 and y0 < y1):
        raise argparse.ArgumentTypeError(f"'{text}' is empty: x0 < x1 and y0 < y1 must hold")
    return x0, x1, y0, y1
