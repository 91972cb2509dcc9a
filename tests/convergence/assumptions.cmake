# What was left out is held against what has happened: one second of injection into a toughness-
# dominated fracture leaves it hardly longer than its process zone, and in rock of 1 md most of the fluid
# would have leaked; the viscosity-dominated one sucks at its tip. (That nothing is said where
# everything holds is part of convergence/kgd/toughness.)
stockwork_case_test(NAME convergence/assumptions/short DECK prm/kgd/toughness/cohesive_xfem.prm
  LABELS quick SET "Time/End time=1 s" "Rock/Bulk model=auto" "Rock/Permeability=1 md"
  EXPECT "warnings >= 2" WARNS "short process zones" "impermeable rock")
stockwork_case_test(NAME convergence/assumptions/suction DECK prm/kgd/viscosity/cohesive_xfem.prm
  SET "Resolution=coarse" "Time/End time=2 s" "In situ/Stress="
  EXPECT "warnings >= 1" WARNS "less than vacuum")
# In three dimensions as well. (Until cells took the mean of the widths that they see of an edge, 1.5e-3 of the fluid was lost
# between those whose normals differ.)
stockwork_case_test(NAME convergence/assumptions/suction/3d DECK tests/data/cloud_of_bonds.prm
  EXPECT "fluid_balance/relative_error < 1e-9" "warnings >= 1" WARNS "less than vacuum")
# In its third step more than 2500 bonds soften, and another solver takes over. 2e-14 were seen.
stockwork_same_test(NAME convergence/peridynamics/many_bonds LABELS nightly DECK tests/data/cloud_of_bonds.prm
  SET "Time/End time=0.0456 s" SECOND_SET "Linear solver/Type=bordered" TOLERANCE 1e-10 IGNORE "error")
