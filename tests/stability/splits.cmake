# (b) Rock and fluid by turns. A column's stiffness is lambda + 2G = 120 MPa, and alpha = 1/2: the drained split
# converges below M = 480 MPa. convergence/split says that each split that ends gives the monolithic answer.
set(one_step "Resolution=coarse" "Coupling/Force=true" "Time/Error tolerance=inf" "Time/Initial step=0.1 s"
  "Time/Minimum step=0.1 s" "Time/End time=0.1 s" "Output/Fields=false")
set(deck prm/column/plane_strain/none.prm)
foreach(scheme drained "fixed strain")
  string(MAKE_C_IDENTIFIER ${scheme} name)
  stockwork_stop_test(NAME stability/b/${name}/fails DECK ${deck}
    SET ${one_step} "Coupling/Scheme=${scheme}" "Rock/Biot modulus=520 MPa"
    SAYS "the ${scheme} split diverges: after") # 1.08 per pass, as 520/480
  stockwork_case_test(NAME stability/b/${name}/below DECK ${deck}
    SET ${one_step} "Coupling/Scheme=${scheme}" "Rock/Biot modulus=440 MPa" EXPECT "linear_iterations < 250")
endforeach()
stockwork_case_test(NAME stability/b/fixed_stress DECK ${deck} # 19 passes at 13 times the limit
  SET ${one_step} "Coupling/Scheme=fixed stress" "Rock/Biot modulus=6060 MPa" EXPECT "linear_iterations < 30")

# With a fracture: half of the compressibility that it has, one pass after another.
set(cracked "Resolution=coarse" "Coupling/Scheme=fixed stress" "Time/End time=0.1 s" "Time/Minimum step=0.005 s"
  "Fracture/peridynamics/Softening=1" "Output/Fields=false")
set(deck prm/kgd/sun/peridynamics.prm)
stockwork_stop_test(NAME stability/b/cracked/fails DECK ${deck}
  SET ${cracked} "Coupling/Acceleration=none" "Coupling/Stabilisation factor=0.45"
  SAYS "the fixed stress split diverges: after")
stockwork_case_test(NAME stability/b/cracked/cured DECK ${deck}
  SET ${cracked} "Coupling/Acceleration=none" EXPECT "linear_iterations < 100")
stockwork_case_test(NAME stability/b/cracked/GMRES DECK ${deck}
  SET ${cracked} "Coupling/Acceleration=GMRES" "Coupling/Stabilisation factor=0.45"
  EXPECT "linear_iterations < 40")
