# Bonds in fluid so viscous that its pressure is a hundred times what they hold (kgd/viscosity, K_m = 0.013).
set(deck prm/kgd/viscosity/peridynamics.prm)
stockwork_check_test(NAME scenes/viscous_bonds/said DECK ${deck} LABELS quick SET "Resolution=coarse"
  SAYS "Fracture/peridynamics/Tracking = path: the fluid is viscous .K_m = 0.0127." WITHOUT "cracks may begin")

# Rock that nothing presses together breaks all over, for it holds 7 kPa. --check says so, and what would hold it; the run ends.
stockwork_check_test(NAME scenes/viscous_bonds/unstressed/foreseen DECK ${deck} LABELS quick
  SET "Resolution=coarse" "In situ/Stress="
  SAYS "cracks may begin in the rock beside the fracture, and the run may end. Rock that is pressed together by 0.211 MPa")
stockwork_stop_test(NAME scenes/viscous_bonds/unstressed DECK ${deck} LABELS quick SET "Resolution=coarse" "In situ/Stress="
  SAYS "bonds are stretched too far up to the rim of the peridynamic zone")
# With one and a half times that it is the fracture that it is under any stress.
stockwork_same_test(NAME scenes/viscous_bonds/stress DECK ${deck} TOLERANCE 1e-3 IGNORE "error|[^t]_inlet_pressure|^inlet_pressure|minimum_pressure|borehole_pressure"
  SET "Resolution=coarse" "Time/End time=3 s" "In situ/Stress=-0.32 MPa, -0.32 MPa" SECOND_SET "In situ/Stress=-60 MPa, -60 MPa")

# A notch at 27 degrees, a third of a cell off the mesh's lines, in -23/-17 MPa, whose well is shut in: ranks, restart.
set(turned tests/data/viscous_turned.prm)
stockwork_same_test(NAME scenes/viscous_bonds/ranks DECK ${turned} RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error)
stockwork_restart_test(NAME scenes/viscous_bonds/restart DECK ${turned} AFTER 12 TOLERANCE 1e-8 IGNORE balance_error
  SET "Checkpoint/Steps between=1")

# Anywhere, in any stress, beside the aligned fracture under the same 30 MPa.
stockwork_campaign_test(turned_stressed 2915 peridynamics "" "" .viscous --pressed 30 --km-from 0.02 --km-to 0.5)

# A natural crack on a row of nodes that is met from the side to which these belong: 0.681 mm and 0.916 MPa at 25 s in place of 0.532
# and 0.702 (coarse; on half the cells 0.675 and 0.909 in place of 0.527 and 0.695).
stockwork_check_test(NAME scenes/row_of_nodes DECK prm/natural_crack/peridynamics.prm LABELS quick
  SET "Resolution=coarse" "Fracture/peridynamics/Tracking=path"
  SAYS "The crack '4 m, -2 m -> 4 m, 2 m' lies on a row of nodes, which belong to its left side")
stockwork_check_test(NAME scenes/row_of_nodes/other_order DECK tests/data/met_from_the_right.prm LABELS quick
  SET "Resolution=coarse" SAYS "The deck is in order" WITHOUT "row of nodes")
stockwork_case_test(NAME scenes/row_of_nodes/opens DECK tests/data/met_from_the_right.prm LABELS nightly SET "Resolution=coarse"
  EXPECT "final/inlet_aperture = 5.35e-4 within 0.01" "final/inlet_pressure = 7.09e5 within 0.02" # of cut cells, coarse: 0.538 mm, 0.71 MPa
         "minimum/minimum_aperture > -1e-7")

# The rate jumps to zero: the second-order scheme starts again, or the fracture goes on filling (8 % too much fluid).
stockwork_case_test(NAME scenes/shut_in_second_order DECK tests/data/shut_in_second_order.prm LABELS quick
  EXPECT "final/fracture_volume = final/injected_volume within 1e-9")
stockwork_restart_test(NAME scenes/shut_in_second_order/restart DECK tests/data/shut_in_second_order.prm LABELS quick TOLERANCE 1e-9
  IGNORE balance_error INTERRUPT_SET "Time/End time=3 s" "Checkpoint/Steps between=1")
