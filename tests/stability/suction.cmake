# (l) A viscous fluid that fills the tip pulls at bonds whose strength is below its suction. Left to themselves they break
# beside the fracture, K_m = 0.5. Fluid that cavitates, tougher rock, K_m = 1.5, or a path.
set(viscous "Resolution=coarse" "Time/End time=1 s" "Time/Scheme=backward Euler" "Output/Fields=false" "In situ/Stress=")
set(left_alone ${viscous} "Fracture/peridynamics/Tracking=none")
set(deck prm/kgd/viscosity/peridynamics.prm)
stockwork_case_test(NAME stability/l/suction/fails DECK ${deck}
  SET ${left_alone} "Rock/Fracture toughness=0.385 MPa m^0.5" EXPECT "final/extent_y > 1") # 2.20 m, longer than broad
stockwork_case_test(NAME stability/l/cavitation DECK ${deck}
  SET ${left_alone} "Rock/Fracture toughness=0.385 MPa m^0.5" "Fracture flow/Vapour pressure=0"
  EXPECT "final/extent_y < 0.01" "final/extent_x > 1")
stockwork_case_test(NAME stability/l/tougher DECK ${deck}
  SET ${left_alone} "Rock/Fracture toughness=1.15 MPa m^0.5" EXPECT "final/extent_y < 0.01" "final/extent_x > 0.9")
stockwork_case_test(NAME stability/l/path DECK ${deck}
  SET ${viscous} "Rock/Fracture toughness=0.385 MPa m^0.5" EXPECT "final/extent_y < 0.01" "final/extent_x > 0.9")
