# Bonds moved by explicit steps.

# Pulled for long, a plate has the energy of uniform tension, 100 J/m, and stays at rest. What a free boundary, or one that is
# pulled, has of bonds is of first order in the cells.
set(deck tests/data/pulled_plate.prm)
stockwork_case_test(NAME convergence/explicit/pulled_plate DECK ${deck}
  SET "Resolution=fine" "Fracture/peridynamics/Growth=false"
  EXPECT "final/stored_energy = 100 within 0.005" "final/kinetic_energy < 1e-12"
         "final/energy_balance_error < 1e-12")
# It moves as by implicit steps, with mass points as well.
stockwork_same_test(NAME convergence/explicit/pulled_plate/newmark DECK ${deck}
  SET "Resolution=medium" "Fracture/peridynamics/Growth=false" "Fracture/peridynamics/Bond volumes=isotropic"
    "Time/Start=at rest" "Time/Initial step=2e-5 s" "Boundary conditions/Normal traction=right: 5e8*t"
  SECOND_SET "Time/Scheme=Newmark" TOLERANCE 1e-3 IGNORE "error")
# Layers that do not contract, E/(1 - nu^2) = 11.25 and 45 GPa over 1 m each: 1/2 (1 MPa)^2 (1 m/11.25 GPa + 1 m/45 GPa) m.
stockwork_case_test(NAME convergence/explicit/pulled_plate/layers DECK ${deck}
  SET "Resolution=fine" "Fracture/peridynamics/Growth=false" "Boundary conditions/Roller=left, bottom, top"
    "Mesh/Region boxes=1: (1 m, 0) to (2 m, 1 m)" "Rock/Region 1/Young modulus=40 GPa"
  EXPECT "final/stored_energy = 55.5556 within 0.005" "final/kinetic_energy < 1e-12"
         "final/energy_balance_error < 1e-12")
# A side that is moved at once is moved in the first step of the run, and its work counts.
stockwork_case_test(NAME convergence/explicit/pulled_plate/jump DECK ${deck}
  SET "Resolution=coarse" "Fracture/peridynamics/Growth=false" "Time/Start=at rest"
    "Boundary conditions/Normal traction=" "Boundary conditions/Displacement x=right: 1 mm"
  EXPECT "final/external_work > 1" "final/energy_balance_error < 1e-10")
# What is pulled must not come off, and be flung away.
stockwork_stop_test(NAME convergence/explicit/pulled_plate/comes_off DECK ${deck} SET "Resolution=coarse"
  SAYS "What is loaded has come off")

# A plate with a notch, pulled suddenly: work, strain energy, energy of the motion and what bonds dissipate balance.
set(deck tests/data/explicit_notch.prm)
stockwork_case_test(NAME convergence/explicit/notch DECK ${deck}
  EXPECT "final/energy_balance_error < 1e-10" "final/dissipated_energy > 1"
         "final/kinetic_energy > 100")
# By implicit steps, with the same mass points.
stockwork_case_test(NAME convergence/explicit/notch/newmark DECK ${deck}
  SET "Time/Scheme=Newmark" "Time/End time=0.5e-3 s" "Fracture/peridynamics/Bond volumes=isotropic"
  EXPECT "final/energy_balance_error < 1e-4" "final/kinetic_energy > 1")
stockwork_case_test(NAME convergence/explicit/notch/brittle DECK ${deck} SET "Fracture/peridynamics/Softening=1"
  EXPECT "final/energy_balance_error < 1e-10" "final/kinetic_energy > 100")
stockwork_same_test(NAME convergence/explicit/notch.2ranks DECK ${deck} RANKS 1,2 TOLERANCE 1e-9
  IGNORE "balance_error")
# A rank knows a part of the bonds, a checkpoint all of them.
stockwork_restart_test(NAME convergence/explicit/notch/restart DECK ${deck} RANKS 3,1 TOLERANCE 1e-9
  INTERRUPT_SET "Time/End time=0.84e-3 s" "Checkpoint/Steps between=84"
  IGNORE "balance_error")

# A strip of PMMA that stores 2.3 G_c forks (Bleyer et al. 2017: from about twice G_c on); with 1.8 G_c one arm runs straight on.
stockwork_case_test(NAME convergence/explicit/pmma_strip/forks DECK prm/dry/pmma_strip/0.040/peridynamics.prm
  SET "Resolution=medium" "Time/End time=3e-5 s" "Output/Fields=false"
  EXPECT "final/forks >= 1" "final/energy_balance_error < 1e-11" "final/extent_y > 3.5e-3")
stockwork_case_test(NAME convergence/explicit/pmma_strip/straight DECK prm/dry/pmma_strip/0.035/peridynamics.prm
  LABELS nightly
  SET "Resolution=medium" "Output/Fields=false"
  EXPECT "final/forks < 0.5" "final/extent_x > 31e-3" "final/extent_y < 1.6e-3")
# A given pressure in a crack: the volume that it holds (Sneddon), which the bond lattice has to a few per cent, and in equilibrium nothing
# moves. The work is p dV, and on any number of ranks the same.
set(deck tests/data/explicit_pressure.prm)
stockwork_case_test(NAME convergence/explicit/pressure DECK ${deck} SET "Resolution=coarse"
  EXPECT "final/error_fracture_volume < 0.03" "final/energy_balance_error < 1e-12" "final/kinetic_energy < 1e-12")
stockwork_case_test(NAME convergence/explicit/pressure/turned DECK ${deck}
  SET "Resolution=medium" "Cracks/Open=-0.8910065 m, -0.4539905 m -> 0.8910065 m, 0.4539905 m"
  EXPECT "final/error_fracture_volume < 0.03" "final/energy_balance_error < 1e-12")
# Where it crosses an interface of rock that is twice as stiff, and grows there.
stockwork_case_test(NAME convergence/explicit/pressure/layers DECK ${deck}
  SET "Resolution=coarse" "Mesh/Region boxes=1: (0, -6 m) to (6 m, 6 m)" "Rock/Region 1/Young modulus=20 GPa" "Rock/Critical energy release rate=100 J/m^2"
    "Rock/Region 1/Critical energy release rate=100 J/m^2" "Verification/Reference=none" "Boundary conditions/Displacement x=" "Boundary conditions/Displacement y=" "Boundary conditions/Roller=left, right, top, bottom" "Time/End time=5e-4 s"
  EXPECT "final/energy_balance_error < 1e-10" "final/dissipated_energy > 10")
# A notch under a pressure of 1.8 G_c, put on at once, forks (dry/bridge); under one of 0.4 G_c it does not grow.
set(deck prm/dry/bridge)
stockwork_case_test(NAME convergence/explicit/bridge/forks DECK ${deck}/1/peridynamics.prm
  SET "Resolution=medium" "Time/End time=2.5e-3 s" "Output/Fields=false"
  EXPECT "final/forks = 1 within 0" "final/energy_balance_error < 1e-11" "final/extent_y > 1.5")
stockwork_case_test(NAME convergence/explicit/bridge/holds DECK ${deck}/0.45/peridynamics.prm
  SET "Resolution=medium" "Output/Fields=false"
  EXPECT "final/dissipated_energy < 1e-12" "final/energy_balance_error < 1e-10")
stockwork_same_test(NAME convergence/explicit/bridge.2ranks DECK ${deck}/1/peridynamics.prm
  SET "Resolution=coarse" "Time/End time=2e-3 s" "Output/Fields=false" RANKS 1,2 TOLERANCE 1e-9 IGNORE "balance_error")
stockwork_restart_test(NAME convergence/explicit/bridge/restart DECK ${deck}/1/peridynamics.prm
  SET "Resolution=coarse" "Time/End time=1.6e-3 s" "Output/Fields=false" RANKS 2,3 TOLERANCE 1e-9
  INTERRUPT_SET "Time/End time=1.2e-3 s" "Checkpoint/Steps between=60" IGNORE "balance_error")
# By implicit steps the tip is where it is by explicit ones at any time, within a cell (0.3 of 2.64 m), and forks as soon.
stockwork_same_test(NAME convergence/explicit/bridge/newmark DECK ${deck}/1/peridynamics.prm LABELS nightly
  SET "Resolution=coarse" "Time/End time=2e-3 s" "Output/Fields=false" SECOND_SET "Time/Scheme=Newmark"
  IN_TIME extent_x dissipated_energy TOLERANCE 0.12)
foreach(scheme explicit Newmark)
  stockwork_case_test(NAME convergence/explicit/bridge/forks/${scheme} DECK ${deck}/1/peridynamics.prm LABELS nightly
    SET "Resolution=coarse" "Time/End time=2.1e-3 s" "Output/Fields=false" "Time/Scheme=${scheme}"
    EXPECT "final/forks = 1 within 0" "final/branches = 3 within 0" "final/extent_x = 2.64 within 0.12")
endforeach()
# The load has a ramp that a step of the run is longer than.
stockwork_case_test(NAME convergence/explicit/notch/quick_load DECK tests/data/explicit_notch.prm
  SET "Time/Initial step=1e-3 s" "Time/Maximum step=1e-3 s"
  WARNS "Loads change within a step of the run" EXPECT "final/energy_balance_error < 1e-10")
stockwork_case_test(NAME convergence/explicit/notch/quick_side DECK tests/data/explicit_notch.prm
  SET "Time/Initial step=1e-3 s" "Time/Maximum step=1e-3 s" "Boundary conditions/Normal traction=" "Boundary conditions/Roller=left"
    "Boundary conditions/Displacement y=top: 1e-6*sin(pi*t/0.9e-3)"
  WARNS "What moves the boundary changes within a step of the run")
stockwork_stop_test(NAME convergence/explicit/notch/no_number DECK tests/data/explicit_notch.prm
  SET "Boundary conditions/Normal traction=top: 1e6/t" SAYS "is not a number everywhere")
# Nothing keeps faces apart, and a notch that is pressed shut is said to overlap.
stockwork_case_test(NAME convergence/explicit/notch/pressed DECK tests/data/explicit_notch.prm
  SET "Boundary conditions/Roller=left, bottom" "Boundary conditions/Normal traction=top: -1e6" "Time/End time=8e-4 s"
  WARNS "faces of cracks stay apart" EXPECT "final/maximum_aperture < 0")
# Nor may a row of nodes that keep the bonds along it.
stockwork_stop_test(NAME convergence/explicit/notch/row_comes_off DECK tests/data/explicit_notch.prm
  SET "Fracture/peridynamics/Unbreakable=" SAYS "What is loaded has come off")
# In three dimensions, on any number of ranks.
set(deck tests/data/explicit_disc.prm)
stockwork_case_test(NAME convergence/explicit/disc DECK ${deck} SET "Output/Fields=false"
  EXPECT "final/energy_balance_error < 1e-10" "final/dissipated_energy > 15")
stockwork_case_test(NAME convergence/explicit/disc/pressure DECK ${deck} SET "Output/Fields=false" "Cracks/Fluid pressure=2 MPa"
  "Boundary conditions/Normal traction="
  EXPECT "final/energy_balance_error < 1e-10" "final/dissipated_energy > 1")
# Where both act, bonds break dry, and fluid comes when they have: it has done half of its work there.
stockwork_case_test(NAME convergence/explicit/disc/pulled_with_pressure DECK ${deck} SET "Output/Fields=false" "Cracks/Fluid pressure=0.3 MPa"
  EXPECT "final/energy_balance_error < 1e-10" "final/dissipated_energy > 15")
stockwork_same_test(NAME convergence/explicit/disc.2ranks DECK ${deck} SET "Output/Fields=false"
  RANKS 1,2 TOLERANCE 1e-9 IGNORE "balance_error")
