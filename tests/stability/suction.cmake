# (l) A viscous fluid that fills the tip pulls at bonds whose strength is below its suction: they break beside the fracture,
# K_m = 0.5. Fluid that cavitates, or tougher rock, K_m = 1.5.
set(viscous "Resolution=coarse" "Time/End time=1 s" "Time/Scheme=backward Euler" "Output/Fields=false")
set(deck prm/kgd/viscosity/peridynamics.prm)
stockwork_case_test(NAME stability/l/suction/fails DECK ${deck}
  SET ${viscous} "Rock/Fracture toughness=0.385 MPa m^0.5" EXPECT "final/extent_y > 1") # 2.20 m, longer than broad
stockwork_case_test(NAME stability/l/cavitation DECK ${deck}
  SET ${viscous} "Rock/Fracture toughness=0.385 MPa m^0.5" "Fracture flow/Vapour pressure=0"
  EXPECT "final/extent_y < 0.01" "final/extent_x > 1")
stockwork_case_test(NAME stability/l/tougher DECK ${deck}
  SET ${viscous} "Rock/Fracture toughness=1.15 MPa m^0.5" EXPECT "final/extent_y < 0.01" "final/extent_x > 0.9")
