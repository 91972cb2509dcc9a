# Where nothing leaks off, a growing fracture holds what was injected, through growth, refinement
# and renumbering: on its symmetry plane, and one that crosses a line of the mesh at a slant.
set(volume EXPECT "final/fracture_volume = final/injected_volume within 1e-8"
  "final/fluid_balance_error < 1e-8" "final/fracture_length > 4")
stockwork_case_test(NAME convergence/volume_straight DECK tests/data/growing_fracture.prm ${volume})
stockwork_case_test(NAME convergence/volume_slanting DECK tests/data/growing_fracture.prm
  SET "Cracks/Open=0, 0.4995 -> 3, 0.6995" "Wells/Well 1/Perforations=0, 0.4995" "Time/End time=12 s"
  ${volume})
