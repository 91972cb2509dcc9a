# Tips whose functions reach over several ranks' cells.
stockwork_same_test(NAME parallel/inclined DECK prm/inclined/30/prescribed.prm
  SET "Resolution=coarse" RANKS 1,2 TOLERANCE 1e-8 IGNORE balance_error)
# Horizons that cross the boundaries between ranks.
stockwork_same_test(NAME parallel/peridynamics DECK prm/sneddon/peridynamics.prm
  SET "Resolution=coarse" RANKS 1,2 TOLERANCE 1e-8)
stockwork_same_test(NAME parallel/peridynamics/growth DECK prm/kgd/sun/peridynamics.prm LABELS quick
  SET "Resolution=coarse" "Time/End time=1 s" RANKS 1,2 TOLERANCE 1e-8
  IGNORE "balance_error|error_fracture_volume")
