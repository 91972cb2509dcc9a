#!/usr/bin/env python3
"""Factors of random rock in the first cells of the lattice along x and y, by an implementation of its own, and the
force on the bar of random_bar.prm that has them [N/m]."""
import argparse
import math

BITS = 2**64 - 1


def mixed(state, number):
    """SplitMix64."""
    state = (state + 0x9E3779B97F4A7C15 + number) & BITS
    state = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & BITS
    state = ((state ^ (state >> 27)) * 0x94D049BB133111EB) & BITS
    return state ^ (state >> 31)


def uniform(key):
    return ((key >> 11) + 0.5) / 2**53


def key(seed, cell):
    result = mixed(mixed(0, seed), 0)
    for index in (*cell, 0):
        result = mixed(result, index & BITS)
    return result


def deviate(seed, cell):
    first = key(seed, cell)
    return math.sqrt(-2 * math.log(uniform(first))) * math.cos(
        2 * math.pi * uniform(mixed(first, 0)))


def exceedance(seed, cell, length):
    if length == 0:
        return uniform(key(seed, cell))
    reach = math.floor(2 * length)
    weight = {(i, j): math.exp(-2 * (i * i + j * j) / length**2)
              for i in range(-reach, reach + 1) for j in range(-reach, reach + 1)}
    total = sum(w * deviate(seed, (cell[0] + i, cell[1] + j)) for (i, j), w in weight.items())
    total /= math.sqrt(sum(w * w for w in weight.values()))
    return 0.5 * math.erfc(total / math.sqrt(2))


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--length", type=float, default=0., help="of correlation, in cells")
parser.add_argument("--seed", type=int, default=3)
parser.add_argument("--modulus", type=float, default=2., help="Weibull's")
options = parser.parse_args()
for name, cells in (("x", [(i, 0) for i in range(8)]), ("y", [(0, i) for i in range(8)])):
    factors = [(-math.log(exceedance(options.seed, cell, options.length)))**(1 / options.modulus)
               for cell in cells]
    print(f"along {name}:", *factors)
    print("  force:", repr(2. * 10e9 * 1e-3 / sum(2. / f for f in factors)))
