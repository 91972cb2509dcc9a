# The poroelastic core on one, two and (sharing the processors) four ranks: columns of errors (about
# 1e-2) agree to 1e-6, hence the fields to 1e-8.
stockwork_same_test(NAME parallel/mandel DECK prm/mandel/none.prm RANKS 1,2 TOLERANCE 1e-6
  SET "Resolution=coarse" "Time/End time=2000 s" "Time/Error tolerance=1e-3")
stockwork_same_test(NAME parallel/mandel_4 DECK prm/benchmark/mandel_2d.prm RANKS 1,4
  TOLERANCE 1e-6 IGNORE peak SET "Time/End time=20 s" "Output/Fields=false")
stockwork_same_test(NAME parallel/cryer DECK prm/cryer/none.prm RANKS 1,2 TOLERANCE 1e-6
  SET "Resolution=coarse" "Time/End time=0.1 s")
# A well whose source is shared by the ranks, and wells beside a growing fracture.
stockwork_same_test(NAME parallel/well_in_rock DECK tests/data/layered_box.prm RANKS 1,2
  TOLERANCE 1e-8 IGNORE "balance_error|defect")
stockwork_same_test(NAME parallel/wells_in_rock DECK tests/data/wells_in_rock.prm RANKS 1,2
  TOLERANCE 1e-7 IGNORE "balance_error|defect" SET "Time/End time=5 s")
