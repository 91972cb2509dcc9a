"""Draw scenes: a KGD fracture somewhere in the mesh, and the aligned one that it must agree with."""
import dataclasses
import math
import zlib

import numpy as np

# Half-length of a KGD fracture over (E' Q^3 t^4 / mu')^(1/6), by K_m (Adachi & Detournay 2002).
# It only chooses the end time: the judge compares runs with one another.
K_M = [0., 0.5, 1., 1.5, 2., 2.5, 3., 4., 5., 6., 8.]
GAMMA = [0.6154, 0.6134, 0.5993, 0.5678, 0.5240, 0.4773, 0.4343, 0.3660, 0.3174, 0.2817, 0.2329]

FAMILIES = {
    "turned": "turned by any angle and moved by any part of a cell",
    "moved": "along the mesh, moved by any part of a cell",
    "stressed": "along the mesh, in stress",
    "turned_stressed": "turned and moved, in stress",
    "mirrored": "turned, moved, mirrored, and its ends exchanged",
    "scaled": "of 1 cm to 100 m, in rock of another modulus, at another rate",
    "one_wing": "one wing, out of any of the four sides",
    "turning": "a notch across the greatest compression, which must turn to it",
}


@dataclasses.dataclass(frozen=True)
class Scene:
    """Lengths in cells where nothing else is said; angles in degrees from the x axis."""
    family: str
    K_m: float
    wing: float                  # length of a wing at the end
    angle: float = 0.            # that the fracture has, or must turn to
    turn: float = 0.             # of the notch against it
    centre: tuple = (0.5, 0.5)   # from the corner of a cell
    along: float = 0.            # compression along the fracture [MPa]
    across: float = 0.           # and across it
    pressed: float = 0.          # and from all sides besides [MPa]
    side: str = ""               # that a single wing comes out of; empty: both wings
    exchanged: bool = False      # the crack's ends listed the other way round
    cell: float = 0.1            # [m]
    modulus: float = 15.96e9     # Young's [Pa]
    toughness: float = 1.3e6     # [Pa m^(1/2)]
    rate: float = 2e-4           # of both wings [m^2/s]

    poisson_ratio = 0.25

    @property
    def notch(self):
        """Half its length. A wing that has turned comes round to the greatest compression slowly, for
        it starts where the notch has left it: from a short notch, in the length that there is."""
        return 6.3 if self.turn else 12.3

    @property
    def plane_modulus(self):
        return self.modulus / (1 - self.poisson_ratio**2)

    @property
    def viscosity(self):
        """That gives K_m = K' / (E'^3 mu' Q)^(1/4), K' = 4 sqrt(2/pi) K_Ic, mu' = 12 mu."""
        scaled = 4 * math.sqrt(2 / math.pi) * self.toughness / self.K_m
        return scaled**4 / (12 * self.plane_modulus**3 * self.rate)

    @property
    def length(self):
        """Of a wing at the end [m]."""
        return self.wing * self.cell

    @property
    def end_time(self):
        gamma = np.interp(self.K_m, K_M, GAMMA)
        return ((self.length / gamma)**1.5
                * (12 * self.viscosity / (self.plane_modulus * self.rate**3))**0.25)

    @property
    def direction(self):
        angle = math.radians(self.angle)
        return np.array([math.cos(angle), math.sin(angle)])

    def straight(self, reach, turn=0.):
        """The two ends of a straight fracture with wings of a length, turned out of its direction."""
        angle = math.radians(turn)
        t = np.array([[math.cos(angle), -math.sin(angle)],
                      [math.sin(angle), math.cos(angle)]]) @ self.direction
        centre = np.array(self.centre)
        return np.array([centre - (0. if self.side else reach) * t, centre + reach * t])

    @property
    def net_pressure(self):
        """At the end, roughly: of a fracture that is open as if its pressure were the same all over."""
        return self.plane_modulus * self.rate * self.end_time / (2 * math.pi * self.length**2)

    @property
    def stress(self):
        """xx, yy, xy [MPa], tension positive."""
        t = self.direction
        n = np.array([-t[1], t[0]])
        tensor = (-(self.along + self.pressed) * np.outer(t, t)
                  - (self.across + self.pressed) * np.outer(n, n))
        return tensor[0, 0], tensor[1, 1], tensor[0, 1]

    def describe(self):
        text = f"K_m {self.K_m:.2f}, {self.angle:6.1f} deg"
        text += f", centre {self.centre[0]:+.2f} {self.centre[1]:+.2f}"
        if self.along or self.across or self.pressed:
            text += f", -{self.along + self.pressed:.1f}/-{self.across + self.pressed:.1f} MPa"
        if self.family == "scaled":
            text += f", wing {self.length:.3g} m, E {self.modulus / 1e9:.3g} GPa, Q {self.rate:.2g} m^2/s"
        if self.turn:
            text += f", notch {self.turn:+.0f} deg"
        return text + (f", from the {self.side}" if self.side else "")


def control(scene):
    """The same fracture in the middle of a row of cells, without stress but what presses all scenes, at the scale of
    always. What turns has none: only its direction is known."""
    return None if scene.family == "turning" else Scene("control", scene.K_m, scene.wing, pressed=scene.pressed)


def draw(family, seed, number, K_m_range=(0.5, 8.), wing=42., pressed=0.):
    """Scene `number` of a family; the others do not matter. K_m is that of the number."""
    K_m = float(np.random.default_rng([seed, number]).uniform(*K_m_range))
    random = np.random.default_rng([seed, zlib.crc32(family.encode()), number])
    angle = float(random.uniform(0., 180.))
    centre = tuple(float(x) for x in random.uniform(-0.5, 0.5, 2))
    along, across = (float(x) for x in sorted(random.uniform(0., 60., 2), reverse=True))
    quarter = int(random.integers(4))
    scene = Scene(family, K_m, wing, pressed=pressed)
    put = dataclasses.replace

    if family == "turned":
        return put(scene, angle=angle, centre=centre)
    if family == "moved":
        return put(scene, angle=90. * (quarter % 2), centre=centre)
    if family == "stressed":
        return put(scene, angle=90. * (quarter % 2), along=along, across=across)
    if family == "turned_stressed":
        return put(scene, angle=angle, centre=centre, along=along, across=across)
    if family == "mirrored":
        # At x = 0, at y = 0, or at both.
        x, y = ((-1, 1), (1, -1), (-1, -1), (-1, -1))[quarter]
        return put(scene, angle=angle if x * y > 0 else 180. - angle,
                   centre=(x * centre[0], y * centre[1]), exchanged=quarter != 3)
    if family == "scaled":
        length = 10**random.uniform(-2., 2.)
        return put(scene, cell=length / wing, modulus=10**random.uniform(9.5, 10.8),
                   toughness=10**random.uniform(5.7, 6.4), rate=10**random.uniform(-5., -3.))
    if family == "one_wing":
        side = ("left", "bottom", "right", "top")[quarter]
        upright = side in ("bottom", "top")
        return put(scene, angle=90. * quarter, side=side,
                   centre=(centre[0], 0.) if upright else (0., centre[1]))
    if family == "turning":
        # The net pressure is small beside the difference of the stresses, or the way to turn is long.
        across = float(random.uniform(0., 30.))
        return put(scene, angle=angle, centre=centre, across=across,
                   along=across + float(random.uniform(5., 12.)) * scene.net_pressure / 1e6,
                   turn=float(random.uniform(30., 70.)) * (1 if quarter % 2 else -1))
    raise ValueError(f"no family '{family}'; there is: {', '.join(FAMILIES)}")
