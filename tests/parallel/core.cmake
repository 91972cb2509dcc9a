# The poroelastic core on one and two ranks. The linear systems are solved to 1e-10.
stockwork_same_test(NAME parallel/mandel DECK prm/mandel/none.prm RANKS 1,2 TOLERANCE 1e-8
  SET "Resolution=coarse" "Time/End time=2000 s" "Time/Error tolerance=1e-3")
stockwork_same_test(NAME parallel/cryer DECK prm/cryer/none.prm RANKS 1,2 TOLERANCE 1e-8
  SET "Resolution=coarse" "Time/End time=0.1 s")
