# Rock that varies from place to place. Its distribution is in unit/random_field_test.

# A bar whose modulus varies along it, against a row of springs whose factors are those of random_bar.py: on the lattice, on
# meshes of half and of a quarter of it, correlated, and of two rocks.
set(exact "final/energy_balance_error < 1e-12" "warnings == 0")
stockwork_case_test(NAME rock/random/bar DECK tests/rock/random_bar.prm LABELS quick
  EXPECT "final/load = 864603.254818622 within 1e-10" ${exact})
foreach(refinements 1 2)
  stockwork_case_test(NAME rock/random/bar/refined_${refinements} DECK tests/rock/random_bar.prm LABELS quick
    SET "Mesh/Uniform refinements=${refinements}" EXPECT "final/load = 864603.254818622 within 1e-10" ${exact})
endforeach()
stockwork_case_test(NAME rock/random/bar/correlated DECK tests/rock/random_bar.prm LABELS quick
  SET "Rock/Random field/Correlation length=4 m" EXPECT "final/load = 1279656.8975139188 within 1e-10" ${exact})
stockwork_case_test(NAME rock/random/bar/layers DECK tests/rock/random_bar.prm LABELS quick
  SET "Mesh/Region boxes=1: (8, 0) to (16, 2)" "Rock/Region 1/Young modulus=20 GPa"
      "Rock/Region 1/Random field/Properties=none"
  EXPECT "final/load = 1226560.5787813177 within 1e-10" ${exact})
stockwork_case_test(NAME rock/random/bar/3d DECK tests/rock/random_bar.prm LABELS quick
  SET "Dimension=3" "Mesh/Box/Upper corner=16 m, 2 m, 2 m" "Mesh/Box/Z spacing=1 cells"
      "Boundary conditions/Roller=left, bottom, front"
  EXPECT "final/load = 1729206.509637244 within 1e-10" ${exact})
# Steady flow up a column whose permeability varies along it: the pressure falls by 1/f_i from cell to cell, and what the
# pores hold at constant total stress is linear in it (factors of random_bar.py, seed 1, one column of the lattice).
stockwork_case_test(NAME rock/random/column DECK tests/rock/permeability.prm LABELS quick
  SET "Rock/Permeability decay stress=" "Rock/Random field/Properties=permeability"
      "Rock/Random field/Weibull modulus=2" "Rock/Random field/Lattice spacing=1.25 m"
  EXPECT "final/pore_volume = -0.05590304665939001 within 1e-10" "warnings == 0")
# The same on 1, 2 and 4 ranks.
foreach(ranks 2 4)
  stockwork_same_test(NAME rock/random/ranks_${ranks} DECK tests/rock/random_bar.prm RANKS 1,${ranks} TOLERANCE 1e-10
    IGNORE balance_error LABELS quick SET "Mesh/Uniform refinements=3")
endforeach()

# A fracture that grows through such rock, on a mesh that is refined ahead of it.
set(random "Rock/Critical energy release rate=31.25 J/m^2" "Rock/Fracture toughness="
  "Rock/Random field/Properties=Young modulus, tensile strength, critical energy release rate"
  "Rock/Random field/Weibull modulus=10" "Rock/Random field/Lattice spacing=1 m")
set(tough "Fracture/Model=damage" "Fracture/cohesive_xfem/Cell size=0" "Fracture/cohesive_xfem/Elastic share=0.01"
  "Fracture/damage/Cell size=0.5 m")
foreach(model cohesive_xfem damage)
  set(of_model ${random})
  if(model STREQUAL "damage")
    list(APPEND of_model ${tough})
  endif()
  stockwork_same_test(NAME rock/random/${model}/ranks DECK tests/data/growing_fracture.prm SET ${of_model}
    RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error)
  stockwork_restart_test(NAME rock/random/${model}/restart DECK tests/data/growing_fracture.prm SET ${of_model}
    RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error INTERRUPT_SET "Time/End time=4 s" "Checkpoint/Steps between=5")
  # As m grows, uniform rock.
  stockwork_same_test(NAME rock/random/${model}/uniform DECK tests/data/growing_fracture.prm SET ${of_model}
    "Rock/Random field/Weibull modulus=1e300" TOLERANCE 1e-12 IGNORE balance_error
    SECOND_SET "Rock/Random field/Properties=" "Rock/Random field/Weibull modulus="
      "Rock/Random field/Lattice spacing=")
endforeach()
# The same with bonds, whose strength is not the rock's.
set(of_bonds Resolution=coarse "Verification/Reference=none" "Time/End time=3 s" "Output/Fields=false"
  "Rock/Random field/Properties=Young modulus, critical energy release rate" "Rock/Random field/Weibull modulus=10"
  "Rock/Random field/Lattice spacing=0.8 m")
foreach(closure conserving "in bonds")
  string(REPLACE " " "_" name ${closure})
  set(of_closure ${of_bonds} "Fracture/peridynamics/Closure=${closure}")
  set(labels)
  if(closure STREQUAL "conserving")
    set(labels LABELS nightly)
  endif()
  stockwork_same_test(NAME rock/random/peridynamics/${name}/ranks DECK prm/kgd/sun/peridynamics.prm SET ${of_closure}
    RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error ${labels})
  stockwork_same_test(NAME rock/random/peridynamics/${name}/uniform DECK prm/kgd/sun/peridynamics.prm SET ${of_closure}
    "Rock/Random field/Weibull modulus=1e300" TOLERANCE 1e-8 IGNORE balance_error
    SECOND_SET "Rock/Random field/Properties=" "Rock/Random field/Weibull modulus="
      "Rock/Random field/Lattice spacing=")
endforeach()
stockwork_restart_test(NAME rock/random/peridynamics/restart DECK prm/kgd/sun/peridynamics.prm SET ${of_bonds}
  RANKS 1,2 TOLERANCE 1e-6 IGNORE balance_error AFTER 12)
stockwork_same_test(NAME rock/random/porous/uniform DECK tests/contract/rock.prm LABELS quick TOLERANCE 1e-12
  IGNORE balance_error
  SET "Verification/Reference=none" "Rock/Random field/Properties=Young modulus, permeability"
      "Rock/Random field/Weibull modulus=1e300" "Rock/Random field/Lattice spacing=1 m"
  SECOND_SET "Rock/Random field/Properties=" "Rock/Random field/Weibull modulus=" "Rock/Random field/Lattice spacing=")

# What is said before the run.
stockwork_rock_audit_test(random tests/rock/random_bar.prm "random rock: mean +0\\.886 .*Young modulus: Weibull, m = 2, .*seed 3")
stockwork_rock_audit_test(random_regions tests/rock/random_bar.prm "random rock: mean, region 1 +0\\.951 .*seed 5"
  "Mesh/Region boxes=1: (8, 0) to (16, 2)" "Rock/Region 1/Random field/Weibull modulus=10"
  "Rock/Region 1/Random field/Seed=5")

# A bar pulled apart where one place is cracked: it takes G_c and carries the strength of that place, whose factor is
# 0.89549916107849761 (random_bar.py, seed 3, m = 10), in cells of a crack band and along a cohesive crack.
set(apart "Rock/Random field/Properties=tensile strength, critical energy release rate"
  "Rock/Random field/Weibull modulus=10" "Rock/Random field/Lattice spacing=1 m" "Rock/Random field/Seed=3")
set(takes "final/dissipated_energy = 44.774958053924877 within 1e-9" "final/peak_load = 447749.58 within 1e-3"
  "final/energy_balance_error < 2e-4" "final/broken_length = 0.5 within 1e-12")
stockwork_case_test(NAME rock/random/apart/damage DECK tests/data/damaged_bar.prm LABELS quick SET ${apart} EXPECT ${takes})
stockwork_case_test(NAME rock/random/apart/cohesive_xfem DECK tests/data/damaged_bar.prm LABELS quick
  SET ${apart} "Fracture/Model=cohesive_xfem" "Fracture/damage/Growth=true" "Fracture/cohesive_xfem/Growth=false"
      "Mesh/Box/Y spacing=3 cells"
  EXPECT ${takes})
# Of weaker rock with the same energy.
stockwork_case_test(NAME rock/random/apart/strength DECK tests/data/damaged_bar.prm LABELS quick
  SET ${apart} "Rock/Random field/Properties=tensile strength"
  EXPECT "final/dissipated_energy = 50 within 1e-9" "final/peak_load = 447749.58 within 0.01")

# In three dimensions a band of cracked cells, on one and two ranks.
stockwork_same_test(NAME rock/random/damage/3d DECK tests/contract/fracture_3d.prm RANKS 1,2 TOLERANCE 1e-6
  IGNORE balance_error
  SET "Fracture/Model=damage" "Rock/Random field/Properties=Young modulus, tensile strength, critical energy release rate"
      "Rock/Random field/Weibull modulus=10" "Rock/Random field/Lattice spacing=1 m")
