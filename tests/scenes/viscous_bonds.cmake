# Bonds in fluid so viscous that its pressure is a hundred times what they hold (kgd/viscosity, K_m = 0.013).
set(deck prm/kgd/viscosity/peridynamics.prm)
stockwork_check_test(NAME scenes/viscous_bonds/said DECK ${deck} LABELS quick SET "Resolution=coarse"
  SAYS "Fracture/peridynamics/Tracking = path: fluid drives the fracture" WITHOUT "cracks may begin")

# Rock that nothing presses together breaks all over, for it holds 7 kPa. --check says so, and what would hold it; the run ends.
stockwork_check_test(NAME scenes/viscous_bonds/unstressed/foreseen DECK ${deck} LABELS quick
  SET "Resolution=coarse" "In situ/Stress="
  SAYS "cracks may begin in the rock beside the fracture, and the run may end. Rock that is pressed together by 0.211 MPa")
stockwork_stop_test(NAME scenes/viscous_bonds/unstressed DECK ${deck} LABELS quick SET "Resolution=coarse" "In situ/Stress="
  SAYS "bonds are stretched too far up to the rim of the peridynamic zone")
# (Pressures that contain the stress are not compared; the net one is.) With one and a half times that it is the fracture that it is under any stress.
stockwork_same_test(NAME scenes/viscous_bonds/stress DECK ${deck} TOLERANCE 1e-3 IGNORE "error|[^t]_inlet_pressure|^inlet_pressure|minimum_pressure|borehole_pressure"
  SET "Resolution=coarse" "Time/End time=3 s" "In situ/Stress=-0.32 MPa, -0.32 MPa" SECOND_SET "In situ/Stress=-60 MPa, -60 MPa")

# A notch at 27 degrees, a third of a cell off the mesh's lines, in -23/-17 MPa, whose well is shut in: ranks, restart.
set(turned tests/data/viscous_turned.prm)
stockwork_same_test(NAME scenes/viscous_bonds/ranks DECK ${turned} RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error)
stockwork_restart_test(NAME scenes/viscous_bonds/restart DECK ${turned} AFTER 12 TOLERANCE 1e-8 IGNORE balance_error
  SET "Checkpoint/Steps between=1")

# Anywhere, in any stress, beside the aligned fracture under the same 30 MPa.
stockwork_campaign_test(turned_stressed 2915 peridynamics "" "" .viscous --pressed 30 --km-from 0.02 --km-to 0.5)

# Vapour that has a greater pressure than presses the crack together opens it by itself, in any model.
foreach(setting "6 MPa;SAYS" "1 kPa;WITHOUT")
  list(GET setting 0 vapour)
  list(GET setting 1 says)
  string(REPLACE " " "_" name "${vapour}")
  stockwork_check_test(NAME scenes/vapour_opens/${name} DECK prm/kgd/viscosity/cohesive_xfem.prm LABELS quick
    SET "Resolution=coarse" "Time/Scheme=backward Euler" "Fracture flow/Vapour pressure=${vapour}"
    ${says} "is more than the stress in situ that presses the crack")
endforeach()
