# KGD fractures in stressed, permeable and leaking rock; doc/cases says what each resolution reaches.
# With toughness and viscosity of the same weight, in the rocks of Wang. The goal is 4 %.
stockwork_case_test(NAME convergence/kgd/wang DECK prm/kgd/wang/cohesive_xfem.prm NEGATIVE
  SET "Resolution=coarse"
  EXPECT "errors/equivalent_length/final < 0.03" "errors/inlet_aperture/final < 0.02"
         "errors/net_inlet_pressure/final < 0.03" "fluid_balance/relative_error < 1e-8"
         "rejected_steps == 0")
# Growth by the effective stress, as published: 20 to 46 times the right pressure.
stockwork_case_test(NAME convergence/kgd/wang/as_published
  DECK prm/kgd/wang/as_published/cohesive_xfem.prm SET "Resolution=coarse"
  EXPECT "errors/net_inlet_pressure/final > 19" "errors/net_inlet_pressure/final < 45"
         "errors/equivalent_length/final > 0.77" "errors/equivalent_length/final < 0.86"
         "fluid_balance/relative_error < 1e-8")
stockwork_case_test(NAME convergence/kgd/wang/hard DECK prm/kgd/wang/hard/cohesive_xfem.prm NEGATIVE
  SET "Resolution=medium"
  EXPECT "errors/equivalent_length/final < 0.04" "errors/inlet_aperture/final < 0.02"
         "errors/net_inlet_pressure/final < 0.03" "fluid_balance/relative_error < 1e-8"
         "rejected_steps == 0")
# In permeable rock what was injected is in the fracture or in the pores.
stockwork_case_test(NAME convergence/kgd/wang/permeable
  DECK prm/kgd/wang/permeable/cohesive_xfem.prm SET "Resolution=coarse" "Time/End time=2 s"
  EXPECT "fluid_balance/relative_error < 1e-8" "final/fluid_balance_error < 1e-8"
         "fluid_balance/leaked > 0" "final/fracture_length > 1.6" "rejected_steps == 0")
# With bonds, beside cut cells on the same cells: at 15 s 7.133 m, 0.6730 mm, 0.3497 MPa, at 40 s 13.81 m, 0.9298 mm, 0.2531 MPa.
# If pieces of the process zone were no segments, the pores ahead of the tip would suck: 6.4, 5.5, 11 % off at 15 s.
set(bonds DECK prm/kgd/wang/permeable/peridynamics.prm SET "Resolution=coarse" "Output/Fields=false")
stockwork_case_test(NAME convergence/kgd/wang/permeable/peridynamics/start ${bonds} "Time/End time=15 s"
  EXPECT "final/equivalent_length = 7.133 within 0.03" "final/inlet_aperture = 6.730e-4 within 0.02"
         "final/net_inlet_pressure = 3.497e5 within 0.04" "fluid_balance/relative_error < 1e-8" "rejected_steps == 0")
stockwork_case_test(NAME convergence/kgd/wang/permeable/peridynamics ${bonds} LABELS nightly
  EXPECT "final/equivalent_length = 13.81 within 0.02" "final/inlet_aperture = 9.298e-4 within 0.02"
         "final/net_inlet_pressure = 2.531e5 within 0.02" "fluid_balance/relative_error < 1e-8" "rejected_steps == 0")
# In the rock that Sun et al. give, which is permeable, beside what bonds give (1.6 m, 0.951 MPa, 0.238 mm).
stockwork_case_test(NAME convergence/kgd/sun/permeable
  DECK prm/kgd/sun/permeable/cohesive_xfem.prm SET "Resolution=medium" "Time/End time=5 s" "Output/Fields=false"
  EXPECT "final/equivalent_length = 1.6 within 0.04" "final/inlet_pressure = 9.51e5 within 0.02" # 0.0234, 0.0083
         "final/inlet_aperture = 2.38e-4 within 0.05" # 0.0319
         "fluid_balance/relative_error < 1e-8" "rejected_steps == 0")
# Leak-off that takes 60 and 97 % of the fluid.
stockwork_case_test(NAME convergence/kgd/carter DECK prm/kgd/carter/cohesive_xfem.prm NEGATIVE
  SET "Resolution=coarse"
  EXPECT "errors/equivalent_length/final < 0.015" "errors/inlet_aperture/final < 0.01"
         "errors/net_inlet_pressure/final < 0.01" "errors/leaked_volume/final < 0.005"
         "fluid_balance/relative_error < 1e-8" "rejected_steps == 0")
stockwork_case_test(NAME convergence/kgd/carter/strong NEGATIVE
  DECK prm/kgd/carter/strong/cohesive_xfem.prm SET "Resolution=coarse"
  EXPECT "errors/equivalent_length/final < 0.01" "errors/inlet_aperture/final < 0.01"
         "errors/net_inlet_pressure/final < 0.005" "errors/leaked_volume/final < 0.001"
         "fluid_balance/relative_error < 1e-8" "rejected_steps == 0")
