# (k) Steps that are longer than the fracture wants, and how far it may advance in one of them. Mean errors.
set(growth "Resolution=coarse" "Time/End time=40 s" "Output/Fields=false")
set(deck prm/kgd/toughness/damage.prm)
stockwork_case_test(NAME stability/k/one_cell/fails DECK ${deck}
  SET ${growth} "Time/Initial step=5 s" "Time/Maximum step=5 s" "Fracture/damage/Most advances per step=1"
  EXPECT "errors/net_inlet_pressure/mean > 1") # 1.33
stockwork_case_test(NAME stability/k/many_cells DECK ${deck}
  SET ${growth} "Time/Initial step=5 s" "Time/Maximum step=5 s" "Fracture/damage/Most advances per step=64"
  EXPECT "errors/net_inlet_pressure/mean < 0.03") # 0.0210
stockwork_case_test(NAME stability/k/short_steps DECK ${deck}
  SET ${growth} "Time/Initial step=1 s" "Time/Maximum step=1 s" "Fracture/damage/Most advances per step=1"
  EXPECT "errors/net_inlet_pressure/mean < 0.03") # 0.0210
