# Cracks that cut saturated rock.
# Leak-off from a crack at a given pressure, and its opening, against the numbers that the formulas
# at the head of the deck give: 3.15899e-5 and 4.21048e-4 m^3 per metre of thickness.
set(column DECK tests/data/porous_column.prm)
stockwork_case_test(NAME convergence/porous/column ${column}
  EXPECT "final/leaked_volume = 3.15899e-5 within 0.01" "final/fracture_volume = 4.21048e-4 within 0.0005"
         "fluid_balance/relative_error < 1e-8")
stockwork_case_test(NAME convergence/porous/column_coarse ${column}
  SET "Mesh/Box/Y spacing=0.2 m around 0 m, growth 1.15"
  EXPECT "final/leaked_volume = 3.15899e-5 within 0.015" "final/fracture_volume = 4.21048e-4 within 0.001")

# A growing fracture: what was injected is in it, in the pores, or has gone through the sides.
set(fracture DECK tests/data/porous_fracture.prm TIMEOUT 120)
stockwork_case_test(NAME convergence/porous/fracture ${fracture}
  EXPECT "fluid_balance/relative_error < 1e-8" "final/fluid_balance_error < 1e-8"
         "fluid_balance/stored > 5e-5" "final/fracture_length > 4")
# Without permeability nothing leaks, whichever law; and the rock is elastic, with its undrained
# constants: K + alpha^2 M = 26.4 GPa and G = 12 GPa.
set(sealed SET "Rock/Permeability=1e-32 m^2" "Rock/Fracture toughness="
  "Rock/Critical energy release rate=31.25 J/m^2")
set(others "leak|stored|outflow|balance|length|energy|pore_volume|minimum_aperture")
stockwork_same_test(NAME convergence/porous/sealed ${fracture} ${sealed} TOLERANCE 1e-6
  SECOND_SET "Fracture flow/Leak-off=none" IGNORE ${others})
stockwork_same_test(NAME convergence/porous/undrained ${fracture} ${sealed}
  "Fracture flow/Leak-off=none" TOLERANCE 2e-3 IGNORE ${others}
  SECOND_SET "Rock/Bulk model=elastic" "Boundary conditions/Drained="
    "Rock/Young modulus=31.2631579 GPa" "Rock/Poisson ratio=0.302631579")
# What leaves through a drained side where cells meet that differ: the equation of a hanging node
# beside it is in part that of a node on it.
stockwork_case_test(NAME convergence/porous/hanging_nodes DECK prm/column/plane_strain/none.prm
  LABELS quick
  SET "Resolution=coarse" "Time/End time=60 s" "Time/Initial step=6 s" "Time/Error tolerance=inf"
    "Time/Scheme=backward Euler" "Mesh/Box/Upper corner=0.8 m, 15 m" "Mesh/Box/X spacing=4 cells"
    "Mesh/Refinement boxes=0.1 m: (0.5 m, 14.5 m) to (0.8 m, 15 m)"
  EXPECT "final/pore_volume < -1.5e-4" "final/fluid_volume_defect < 1e-14"
         "final/fluid_volume_defect > -1e-14")
