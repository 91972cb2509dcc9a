# The poroelastic core on one, two and (sharing the processors) four ranks: columns of errors (about
# 1e-2) agree to 1e-6, hence the fields to 1e-8.
stockwork_same_test(NAME parallel/mandel DECK prm/mandel/none.prm RANKS 1,2 TOLERANCE 1e-6
  SET "Resolution=coarse" "Time/End time=2000 s" "Time/Error tolerance=1e-3")
stockwork_same_test(NAME parallel/mandel_4 DECK prm/benchmark/mandel_2d.prm RANKS 1,4
  TOLERANCE 1e-6 IGNORE peak SET "Time/End time=20 s" "Output/Fields=false")
stockwork_same_test(NAME parallel/cryer DECK prm/cryer/none.prm RANKS 1,2 TOLERANCE 1e-6
  SET "Resolution=coarse" "Time/End time=0.1 s")
