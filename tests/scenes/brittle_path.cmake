# Brittle bonds on a path: fractures keep to it, in any direction, however short the steps are. (Without one, with steps of
# 0.04 s, such a fracture leaves the axis of kgd/sun, or ends at the rim of its zone.)
set(brittle "Fracture/peridynamics/Softening=1" "Fracture/peridynamics/Tracking=path")
stockwork_case_test(NAME scenes/brittle_path/short_steps DECK prm/kgd/sun/peridynamics.prm
  SET "Resolution=coarse" "Time/End time=5 s" "Time/Maximum step=0.04" "Output/Fields=false" ${brittle}
  EXPECT "errors/equivalent_length/mean < 0.035" "errors/inlet_aperture/mean < 0.075" "errors/net_inlet_pressure/mean < 0.09"
         "final/extent_y < 0.02" "rejected_steps < 5" "fluid_balance/relative_error < 1e-8")
# At 27 degrees, a third of a cell off, in -23/-17 MPa: the length by energy and the volume.
set(turned tests/data/turned_in_situ.prm)
stockwork_case_test(NAME scenes/brittle_path/turned DECK ${turned} SET ${brittle}
  EXPECT "final/equivalent_length = 3.64 within 0.035" "final/fracture_volume = final/injected_volume within 1e-12"
         "rejected_steps < 5")
stockwork_same_test(NAME scenes/brittle_path/turned/state_based DECK ${turned} LABELS quick TOLERANCE 1e-6 IGNORE "balance_error|cost"
  SET ${brittle} SECOND_SET "Fracture/peridynamics/Bond law=state-based")
stockwork_same_test(NAME scenes/brittle_path/ranks DECK ${turned} RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error SET ${brittle})
# In porous rock, at a natural crack.
stockwork_restart_test(NAME scenes/brittle_path/natural_crack/restart DECK prm/natural_crack/60/peridynamics.prm AFTER 30
  TOLERANCE 1e-8 IGNORE balance_error LABELS nightly
  SET ${brittle} "Time/End time=4 s" "Output/Fields=false" "Checkpoint/Steps between=1")
# Dry until a fracture joins it: what stress in situ does between the faces of a dry path is its bonds'.
stockwork_case_test(NAME scenes/brittle_path/joined DECK tests/data/soft_spot_ahead.prm SET ${brittle} WARNS "It is dry until a fracture joins it"
  EXPECT "final/extent_x > 1.7" "final/fracture_volume = final/injected_volume within 1e-12" "fluid_balance/relative_error < 1e-12")
stockwork_restart_test(NAME scenes/brittle_path/joined/restart DECK tests/data/soft_spot_ahead.prm AFTER 15 RANKS 1,2 TOLERANCE 1e-7
  IGNORE balance_error SET ${brittle} "Time/End time=8.5 s")
