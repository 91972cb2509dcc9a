# Tips whose functions reach over several ranks' cells.
stockwork_same_test(NAME parallel/inclined DECK prm/inclined/30/prescribed.prm
  SET "Resolution=coarse" RANKS 1,2 TOLERANCE 1e-8)
