"""Published criteria: does a hydraulic fracture cross a natural crack? Python standard library.

Compression is positive: the greatest S_H along the fracture's way, the least S_h across it, both less the pore
pressure. The natural crack is at an angle to the way, 90 degrees: across it; mu is its friction, S_0 its cohesion,
T_0 the rock's tensile strength. All have units of stress; what is returned has them, too.

None of the papers was at hand, nor could a text with the equations be found. They are as later papers quote them, from
memory: second hand, and checked against what they must follow from (tests/driver/natural_crack_test.py). So numbers
of equations are not given.

Renshaw & Pollard (1995), Int. J. Rock Mech. Min. Sci. 32, 237-249: the field of a crack's tip (Westergaard), on the
natural crack, which is at right angles. Rock beyond it breaks, before the crack slips, where

    S_H/(T_0 + S_h) > (0.35 + 0.35/mu)/1.06.

Gu & Weng (2010), ARMA 10-198, and Gu et al. (2012), SPE Prod. & Oper. 27, 20-26: the same at any angle, and with
cohesion. On the natural crack on either side of the tip the greatest principal stress is T_0 at some distance; the
crack must not slip there.

Blanton (1982), SPE 10847, and (1986), SPE 15261: the pressure of the fluid that has stopped at the natural crack
opens it or breaks the rock beyond. It crosses where

    S_H - S_h > -T_0/(cos 2 beta - b sin 2 beta),

with b by the part of the natural crack that slips, of which the friction takes up the shear.

What they leave out: how much fluid there is and how viscous it is, toughness (a strength alone breaks the rock),
the lengths of both cracks, leak-off, and what becomes of a fracture that has begun on the far side. Those by the
tip's field leave out the fluid's pressure in the natural crack, that by the pressure leaves out the tip's field.
"""
import math

NEVER = math.inf


def renshaw_pollard(mu):
    """The least S_H/(T_0 + S_h) with which an uncemented natural crack at right angles is crossed."""
    return (0.35 + 0.35 / mu) / 1.06


def renshaw_pollard_contrast(least, strength, mu):
    """The same as a contrast S_H - S_h, not below zero."""
    return max(0., renshaw_pollard(mu) * (strength + least) - least)


def tip_stress(greatest, least, intensity, theta):
    """(xx, yy, xy), tension positive, of a crack's tip on x in stress in situ, where K_I/sqrt(2 pi r) is the intensity."""
    c, s, c3, s3 = (f(0.5 * k * theta) for k in (1, 3) for f in (math.cos, math.sin))
    return (-greatest + intensity * c * (1. - s * s3), -least + intensity * c * (1. + s * s3), intensity * s * c * c3)


def intensity_at_strength(greatest, least, strength, theta):
    """K_I/sqrt(2 pi r) for which the greatest principal stress is the strength: of

        cos(theta/2)^2 K^2 + 2 (D sin(theta/2) sin(3 theta/2) - T) K + T^2 - D^2 = 0,

    K = intensity cos(theta/2), T = T_0 + (S_H + S_h)/2, D = -(S_H - S_h)/2, the smaller root; with the larger one
    the least principal stress is the strength."""
    c, s, s3 = math.cos(0.5 * theta), math.sin(0.5 * theta), math.sin(1.5 * theta)
    mean, half = strength + 0.5 * (greatest + least), -0.5 * (greatest - least)
    linear = mean - half * s * s3
    root = math.sqrt(max(0., linear**2 - c**2 * (mean**2 - half**2)))
    return (mean**2 - half**2) / (linear + root) / c


def gu_weng_margin(angle, greatest, least, strength, mu, cohesion=0.):
    """What the natural crack holds more than its shear is, where the rock beside it breaks; below zero it slips. The
    angle is in degrees."""
    beta = math.radians(angle)
    margins = []
    for theta in (beta, beta - math.pi):
        xx, yy, xy = tip_stress(greatest, least, intensity_at_strength(greatest, least, strength, theta), theta)
        normal = 0.5 * (xx + yy) - 0.5 * (xx - yy) * math.cos(2. * beta) - xy * math.sin(2. * beta)
        shear = -0.5 * (xx - yy) * math.sin(2. * beta) + xy * math.cos(2. * beta)
        margins.append(cohesion - mu * normal - abs(shear))
    return min(margins)


def gu_weng_contrast(angle, least, strength, mu, cohesion=0., most=100.):
    """The least S_H - S_h with which it is crossed; NEVER if that is more than `most` strengths."""
    contrast, step = 0., 0.01 * strength
    while gu_weng_margin(angle, least + contrast, least, strength, mu, cohesion) <= 0.:
        contrast += step
        if contrast > most * strength:
            return NEVER
    low, high = max(0., contrast - step), contrast
    for _ in range(50):
        middle = 0.5 * (low + high)
        if gu_weng_margin(angle, least + middle, least, strength, mu, cohesion) > 0.:
            high = middle
        else:
            low = middle
    return high if high > 1e-9 * strength else 0.


def blanton_b(mu):
    """Of a natural crack that is open nowhere: the stress along it, over the shear stress, where it is greatest, at a
    share y of the slipping part."""
    small = math.exp(-math.pi / (2. * mu))
    y = math.sqrt(small / (1. + small))
    return math.log((1. + y) / (1. - y)) / math.pi


def blanton_contrast(angle, strength, mu):
    """The least S_H - S_h with which it is crossed; NEVER at small angles."""
    beta = math.radians(angle)
    divisor = math.cos(2. * beta) - blanton_b(mu) * math.sin(2. * beta)
    return -strength / divisor if divisor < 0. else NEVER
