"""The analytical solutions that Zhang, Cao, Wang & Guo (2022) draw beside their results, repaired. SI units;
the rate is that into one wing, a pressure is net of the stress across the fracture. Python standard library."""
import math


def length(rate, time, height, carter):
    """Half-length of a fracture of constant height that loses nearly all of its fluid, Eq. 42, first line
    (Nordgren 1972): what the wing's two faces take is the rate."""
    return rate * math.sqrt(time) / (math.pi * height * carter)


def width(rate, time, height, carter, shear, poisson, viscosity):
    """Width in the middle of its height at the well, Eq. 42, second line (Nordgren 1972)."""
    return 4. * (2. * (1. - poisson) * viscosity * rate**2
                 / (math.pi**3 * shear * height * carter))**0.25 * time**0.125


def pressure_of_width(width_, height, shear, poisson):
    """Pressure that opens a fracture of constant height by as much, each section for itself: what belongs to
    the second line of Eq. 42."""
    return shear * width_ / ((1. - poisson) * height)


def pressure(rate, length_, height, shear, poisson, viscosity):
    """Eq. 42, third line, is the one of a fracture in plane strain (Geertsma & de Klerk 1969). Printed, it has
    lost G^3 and the height and has a factor of 0.32e-15 for the leak-off; here without a factor."""
    return 1.135 * (shear**3 * rate * viscosity / ((1. - poisson)**3 * height * length_**2))**0.25


def carter_coefficient(excess, permeability, storage, viscosity):
    """Of one face of rock at rest that a pressure in excess of its own enters (Carter 1957) [m/s^0.5]."""
    return excess * math.sqrt(permeability * storage / (math.pi * viscosity))


def stored_length(rate, time, height, shear, poisson, viscosity):
    """Half-length of the same fracture without leak-off (Nordgren 1972)."""
    return 0.68 * (shear * rate**3 / ((1. - poisson) * viscosity * height**4))**0.2 * time**0.8


def stored_width(rate, time, height, shear, poisson, viscosity):
    """Width in the middle of its height at the well (Nordgren 1972)."""
    return 2.5 * ((1. - poisson) * viscosity * rate**2 / (shear * height))**0.2 * time**0.2


def tip_width(distance, speed, modulus, viscosity):
    """Width behind the tip of a fracture in plane strain that viscous fluid drives, Eq. 43 with its units
    (Desroches et al. 1994): alpha = 2/3. The modulus is that of plane strain."""
    return 2.**(1. / 3.) * 3.**(5. / 6.) * (12. * viscosity * speed / modulus)**(1. / 3.) * distance**(2. / 3.)


def tip_pressure(distance, speed, modulus, viscosity):
    """Net pressure there, second line of Eq. 43."""
    alpha = 2. / 3.
    return (modulus / 4. * alpha / math.tan(math.pi * alpha)
            * tip_width(distance, speed, modulus, viscosity) / distance)
