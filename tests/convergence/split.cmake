# Splits give the monolithic answer: columns of errors (1e-4 to 1e-2) agree to 1e-6, hence the
# fields to better than 1e-8. alpha^2 M / K = 1/2, where every split converges in rock without a fracture.
set(consolidation "Resolution=coarse" "Time/End time=60 s" "Time/Initial step=10 s"
  "Time/Error tolerance=inf" "Rock/Biot modulus=133.333 MPa" "Nonlinear solver/Tolerance=1e-11"
  "Output/Fields=false")
foreach(scheme "fixed stress" "undrained" "drained" "fixed strain")
  string(REPLACE " " "_" name ${scheme})
  stockwork_same_test(NAME convergence/split/${name} DECK prm/column/plane_strain/none.prm
    TOLERANCE 1e-6 LABELS quick SET ${consolidation} SECOND_SET "Coupling/Scheme=${scheme}")
endforeach()
# With bonds, too, whose matrix is not symmetric.
foreach(scheme "fixed stress" "undrained")
  string(REPLACE " " "_" name ${scheme})
  stockwork_same_test(NAME convergence/split/peridynamics/${name}
    DECK prm/column/plane_strain/peridynamics.prm TOLERANCE 1e-6 LABELS quick
    SET ${consolidation} SECOND_SET "Coupling/Scheme=${scheme}")
endforeach()

# And with fractures that grow: fluid in a network, in rock with pores and without, and in the pores'
# own elements; another fracture model; passes that are not combined.
set(growth "Resolution=coarse" "Nonlinear solver/Tolerance=1e-11" "Output/Fields=false")
set(rounding "balance_error|error_fracture_volume")
set(fixed_stress "Coupling/Scheme=fixed stress")
stockwork_same_test(NAME convergence/split/fracture DECK prm/kgd/sun/peridynamics.prm RANKS 1,2
  TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=1 s" SECOND_SET ${fixed_stress})
stockwork_same_test(NAME convergence/split/fracture/plain DECK prm/kgd/sun/peridynamics.prm RANKS 1,2
  TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=0.5 s"
      "Fracture/peridynamics/Softening=1"
  SECOND_SET ${fixed_stress} "Coupling/Acceleration=none")
# The answer does not tell whether the compressibility given to the fracture is right, the number of
# passes does: with half of it they diverge, with twice of it there are twice as many.
stockwork_case_test(NAME convergence/split/fracture/passes DECK prm/kgd/sun/peridynamics.prm RANKS 2
  SET "Resolution=coarse" "Output/Fields=false" "Time/End time=0.5 s"
      "Fracture/peridynamics/Softening=1" ${fixed_stress} "Coupling/Acceleration=none"
  EXPECT "linear_iterations < 600")
stockwork_same_test(NAME convergence/split/fracture/porous DECK prm/kgd/sun/permeable/peridynamics.prm
  RANKS 1,2 TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=0.5 s" SECOND_SET ${fixed_stress})
stockwork_same_test(NAME convergence/split/fracture/tensor DECK prm/kgd/sun/permeable/peridynamics.prm
  TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=0.5 s"
      "Fracture/peridynamics/Fluid=permeability tensor" SECOND_SET ${fixed_stress})
stockwork_same_test(NAME convergence/split/fracture/cohesive_xfem
  DECK prm/kgd/toughness/cohesive_xfem.prm TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=1 s"
  SECOND_SET ${fixed_stress})
# Cracks in cells, which soften: the matrix of what moves is indefinite at times. In two and three dimensions.
stockwork_same_test(NAME convergence/split/fracture/damage DECK prm/kgd/toughness/damage.prm RANKS 1,2
  TOLERANCE 1e-6 IGNORE ${rounding} SET ${growth} "Time/End time=3 s" SECOND_SET ${fixed_stress})
stockwork_same_test(NAME convergence/split/fracture/damage/3d DECK tests/contract/fracture_3d.prm
  TOLERANCE 1e-6 IGNORE ${rounding}
  SET "Nonlinear solver/Tolerance=1e-11" "Fracture/Model=damage" "Wells/Well 1/Rate=1e-3" "Time/End time=3 s"
  SECOND_SET ${fixed_stress})
