# Opening and shear together: what pulling two blocks apart at an angle takes is G_I + (G_II - G_I) B^eta, where B,
# the share of shear in the work, is the sine of the angle squared (Benzeggagh and Kenane 1996; G_I 100,
# G_II 300 J/m^2). external_work is the work of the top, which knows nothing of the law.
foreach(entry "0:0:1:1.5:100" "30:0.5:0.8660254:1.5:125" "45:0.7071068:0.7071068:1.5:170.7107"
              "60:0.8660254:0.5:1.5:229.9038" "90:1:0:1.5:300"
              # Negative twins: other exponents, other energies.
              "45/quadratic:0.7071068:0.7071068:2:150" "45/linear:0.7071068:0.7071068:1:200")
  string(REPLACE ":" ";" entry "${entry}")
  list(GET entry 0 name)
  list(GET entry 1 sine)
  list(GET entry 2 cosine)
  list(GET entry 3 exponent)
  list(GET entry 4 energy)
  stockwork_case_test(NAME convergence/mixed_mode/${name} DECK tests/data/pulled_apart.prm
    SET "Boundary conditions/Displacement x=top: ${sine}e-3 * t"
        "Boundary conditions/Displacement y=top: ${cosine}e-3 * t"
        "Fracture/cohesive_xfem/Mixed-mode exponent=${exponent}"
    EXPECT "final/external_work = ${energy} within 0.001" "final/dissipated_energy = ${energy} within 1e-4"
           "final/broken_length == 1")
endforeach()
# Cement takes its share.
stockwork_case_test(NAME convergence/mixed_mode/cement DECK tests/data/pulled_apart.prm
  SET "Fracture/cohesive_xfem/Cohesive energy=0.5"
  EXPECT "final/external_work = 85.35534 within 0.001" "final/dissipated_energy = 85.35534 within 1e-4"
         "final/broken_length == 1")
