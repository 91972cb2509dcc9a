"""Write a scene as a deck that needs no other file."""
import numpy as np

GROWTH = 1.4     # of cells towards the walls
WALLS = 12       # lengths of a wing

DECK = """# {about}
# Drawn by contrib/campaign.py --family {family} --seed {seed}; compare with control.prm.
set Title      = {family} {number}: {about}
set Dimension  = 2
set Resolution = coarse
{elements}
subsection Mesh
  subsection Box
    set Lower corner = {lower[0]:.9g} m, {lower[1]:.9g} m
    set Upper corner = {upper[0]:.9g} m, {upper[1]:.9g} m
    set X spacing    = {cell:.9g} m from {low[0]:.9g} m to {high[0]:.9g} m, growth {growth}
    set Y spacing    = {cell:.9g} m from {low[1]:.9g} m to {high[1]:.9g} m, growth {growth}
  end
end
subsection Rock
  set Bulk model         = elastic
  set Young modulus      = {scene.modulus:.9g} Pa
  set Poisson ratio      = {scene.poisson_ratio}
  set Fracture toughness = {scene.toughness:.9g} Pa m^0.5
end
{in_situ}subsection Fluid
  set Viscosity = {scene.viscosity:.9g} Pa s
end
subsection Boundary conditions
  set Roller = left, right, top, bottom
end
subsection Cracks
  set Open = {notch[0][0]:.9g} m, {notch[0][1]:.9g} m -> {notch[1][0]:.9g} m, {notch[1][1]:.9g} m
end
subsection Wells
  subsection Well 1
    set Control           = rate
    set Rate              = {scene.rate:.9g} m^2/s
    set Perforations      = {centre[0]:.9g} m, {centre[1]:.9g} m
    set Fraction in model = {fraction}
  end
end
subsection Fracture
  set Model = {model}
{own}end
subsection Time
  set End time     = {end:.9g} s
  set Initial step = {initial:.9g} s
  set Maximum step = {most:.9g} s
end
subsection Output
  set Steps between fields = 0
end
"""

IN_SITU = """subsection In situ
  set Stress = {0:.9g} MPa, {1:.9g} MPa, {2:.9g} MPa
end
"""

PERIDYNAMICS = """  subsection peridynamics
    set Closure = in bonds
    set Tracking = path
    set Zone = ({0[0]:.9g} m, {0[1]:.9g} m) to ({1[0]:.9g} m, {1[1]:.9g} m)
  end
"""


def corners(scene, margin):
    """Of the box, along mesh lines, that holds the fracture and so many cells around it [cells]."""
    points = np.concatenate([scene.straight(scene.wing), scene.straight(scene.notch, scene.turn)])
    low, high = np.floor(points.min(axis=0)) - margin, np.ceil(points.max(axis=0)) + margin
    if scene.side:  # where a wing begins, the body ends
        axis, end = (0 if scene.side in ("left", "right") else 1), scene.side in ("left", "bottom")
        (low if end else high)[axis] = 0.
    return low, high


def deck(scene, model="cohesive_xfem", seed=0, number=0):
    bonds = model == "peridynamics"
    own = ""
    low, high = corners(scene, 8)
    if bonds:  # a horizon of cells of one size around the zone, and more
        own = PERIDYNAMICS.format(low * scene.cell, high * scene.cell)
        low, high = corners(scene, 14)
    reach = np.array([-1., 1.])[:, None] * np.ones(2) * WALLS * scene.wing
    for axis in (0, 1):
        for row, edge in ((0, low), (1, high)):
            if scene.side and edge[axis] == 0.:
                reach[row, axis] = 0.
    notch = scene.straight(scene.notch, scene.turn)
    if scene.exchanged:
        notch = notch[::-1]
    fraction = 0.5 if scene.side else 1
    stressed = scene.along or scene.across or scene.pressed
    return DECK.format(
        about=scene.describe(), family=scene.family, seed=seed, number=number, scene=scene, model=model,
        elements="\nsubsection Discretisation\n  set Elements = Q1-Q1 stabilised\nend\n" if model != "cohesive_xfem" else "",
        lower=reach[0] * scene.cell, upper=reach[1] * scene.cell, cell=scene.cell, growth=GROWTH,
        low=low * scene.cell, high=high * scene.cell, notch=notch * scene.cell,
        in_situ=IN_SITU.format(*scene.stress) if stressed else "",
        centre=np.array(scene.centre) * scene.cell, fraction=fraction, own=own, end=scene.end_time,
        initial=scene.end_time / 600, most=scene.end_time / 40)
