# (a) Pressure beside displacement, in the undrained limit and in short steps. The exact pressure is 1 Pa.
set(deck prm/stability/undrained/none.prm)
stockwork_case_test(NAME stability/a/equal_order/fails DECK ${deck} LABELS quick
  SET "Discretisation/Elements=Q1-Q1"
  EXPECT "fields/pore_pressure/maximum > 1.9") # 2.000: from node to node 0, 2, 0, 2
stockwork_case_test(NAME stability/a/equal_order/stabilised DECK ${deck} LABELS quick
  SET "Discretisation/Elements=Q1-Q1 stabilised"
  EXPECT "fields/pore_pressure/maximum < 1.3") # 1.268, in the one node beside the drained side
stockwork_case_test(NAME stability/a/equal_order/quadratic DECK ${deck} LABELS quick
  SET "Discretisation/Elements=Q2-Q1"
  EXPECT "fields/pore_pressure/maximum < 1.3") # 1.268, likewise
# A tenth of h^2/(6 c_v), and all of it.
foreach(pair "Q1-Q1 stabilised" "Q2-Q1")
  string(MAKE_C_IDENTIFIER ${pair} name)
  stockwork_case_test(NAME stability/a/short_step/${name}/fails DECK ${deck}
    SET "Discretisation/Elements=${pair}" "Rock/Permeability=0.1/6e13 m^2"
    EXPECT "fields/pore_pressure/maximum > 1.1") # 1.225, both
  stockwork_case_test(NAME stability/a/short_step/${name}/cured DECK ${deck}
    SET "Discretisation/Elements=${pair}" "Rock/Permeability=1.01/6e13 m^2"
    EXPECT "fields/pore_pressure/maximum < 1.0001")
endforeach()
