# Bonds on tracked paths: where no path is near, a crack begins.
# The spot in the plate, 0.9 m to the right of the origin, 0.6 m above it and half a metre wide: the crack goes through
# all of it. So it does in the plate turned by 27 degrees, on cells moved by a third of one.
set(goes_through "warnings == 2" "final/fracture_length > 1" "final/fracture_length < 1.5" "final/broken_length > 0.6")
stockwork_case_test(NAME scenes/new_path DECK tests/data/soft_spot.prm LABELS quick
  WARNS "A crack begins at (0.8879 0.6098) m, at 3 s, -0.2" EXPECT ${goes_through})
stockwork_case_test(NAME scenes/new_path/turned DECK tests/data/soft_spot_turned.prm
  WARNS "A crack begins at (0.5018 0.9333) m, at 2.75 s, 26.8" EXPECT ${goes_through})
stockwork_same_test(NAME scenes/new_path/ranks DECK tests/data/soft_spot.prm RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error
  SET "Time/End time=4 s" "Time/Initial step=1 s" "Time/Maximum step=1 s")
# What the crack takes is that without stress in situ, 3.72 J/m.
stockwork_case_test(NAME scenes/new_path/in_situ DECK tests/data/soft_spot_in_situ.prm
  EXPECT "final/dissipated_energy = 3.72 within 0.03")

# Dry until a fracture joins it, which then has fluid in all of both; and over a restart on two ranks while it is dry.
stockwork_case_test(NAME scenes/new_path/joined DECK tests/data/soft_spot_ahead.prm WARNS "It is dry until a fracture joins it"
  EXPECT "final/extent_x > 1.7" "final/fracture_volume = final/injected_volume within 1e-12" "fluid_balance/relative_error < 1e-12")
stockwork_restart_test(NAME scenes/new_path/restart DECK tests/data/soft_spot_ahead.prm AFTER 7 RANKS 1,2 TOLERANCE 1e-7
  IGNORE balance_error SET "Time/End time=2.5 s")

# Where the stress is far below the strength none begins: the three are of what the run assumes.
stockwork_case_test(NAME scenes/new_path/none DECK prm/kgd/sun/peridynamics.prm
  SET Resolution=coarse "In situ/Stress=-5 MPa, -3 MPa" Verification/Reference=none "Time/End time=3 s" Output/Fields=false
  EXPECT "warnings == 3")

# Tips that come past one another within a cell and a half join. Where they run on side by side, the length of both is 3.02 m.
stockwork_case_test(NAME scenes/passing_tips DECK tests/data/en_echelon.prm
  EXPECT "final/fracture_length = 2.85 within 0.02" "final/fracture_volume = final/injected_volume within 1e-12"
         "fluid_balance/relative_error < 1e-12")
