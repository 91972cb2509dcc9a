# Fractures against their references, at the coarse resolution; doc/cases says what each reaches.
stockwork_case_test(NAME convergence/kgd/toughness DECK prm/kgd/toughness/cohesive_xfem.prm NEGATIVE
  SET "Resolution=coarse"
  EXPECT "errors/fracture_length/final < 0.01" "errors/fracture_length/mean < 0.01"
         "errors/inlet_aperture/final < 0.01" "errors/inlet_aperture/mean < 0.01"
         "errors/inlet_pressure/final < 0.02" "errors/inlet_pressure/mean < 0.02"
         "fluid_balance/relative_error < 1e-8")
stockwork_case_test(NAME convergence/kgd/viscosity DECK prm/kgd/viscosity/cohesive_xfem.prm
  SET "Resolution=coarse"
  EXPECT "errors/fracture_length/final < 0.035" "errors/inlet_aperture/final < 0.02"
         "errors/inlet_pressure/final < 0.02" "fluid_balance/relative_error < 1e-8")
stockwork_case_test(NAME convergence/sneddon DECK prm/sneddon/prescribed.prm NEGATIVE
  SET "Resolution=coarse"
  EXPECT "errors/fracture_volume/final < 0.02" "errors/stress_intensity_I/final < 0.005")
foreach(angle 0 30 45)
  stockwork_case_test(NAME convergence/inclined/${angle} DECK prm/inclined/${angle}/prescribed.prm
    SET "Resolution=coarse" EXPECT "errors/stress_intensity_I/final < 0.01")
endforeach()
