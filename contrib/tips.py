"""Speeds of tips: how fast an extent of statistics.csv has grown, and the speed of Rayleigh waves to measure it by."""
import math

from results import ResultError

# Units in the decks that are asked, and others that '--set' may bring.
SI = {"": 1., "GPa": 1e9, "MPa": 1e6, "Pa": 1., "m": 1., "cm": 1e-2, "mm": 1e-3, "s": 1., "ms": 1e-3, "min": 60.,
      "kg/m^3": 1.}


def number(text):
    """Of an entry of a deck in SI units."""
    value, unit = (text.split() + [""])[:2]
    if unit not in SI:
        raise ResultError(f"'{text}': the unit is none of {', '.join(filter(None, SI))}")
    if "/" in value:
        upper, lower = value.split("/")
        return float(upper) / float(lower) * SI[unit]
    return float(value) * SI[unit]


def rayleigh_speed(deck):
    """Of the drained rock, after Viktorov (1967): c_s (0.862 + 1.14 nu)/(1 + nu), in plane stress with nu/(1 + nu)."""
    stiffness, ratio = number(deck["Rock/Young modulus"]), number(deck["Rock/Poisson ratio"])
    shear_speed = math.sqrt(0.5 * stiffness / (1. + ratio) / number(deck["Rock/Density"]))
    if deck.get("Rock/Plane state") == "plane stress":
        ratio /= 1. + ratio
    return shear_speed * (0.862 + 1.14 * ratio) / (1. + ratio)


def greatest_speed(times, places, least_way):
    """Of a tip [m/s]: the shortest time in which it comes at least so far."""
    fastest, last = 0., 0
    for first in range(len(times)):
        while last < len(times) and places[last] - places[first] < least_way:
            last += 1
        if last == len(times):
            break
        fastest = max(fastest, (places[last] - places[first]) / (times[last] - times[first]))
    return fastest
