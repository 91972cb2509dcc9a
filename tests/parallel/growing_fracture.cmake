# A growing fracture with refinement around its tip.
foreach(ranks 2 4)
  stockwork_same_test(NAME parallel/growing_fracture_${ranks} DECK tests/data/growing_fracture.prm
    RANKS 1,${ranks} TOLERANCE 1e-8 IGNORE balance_error)
endforeach()

# Where bonds soften, steps end on kinks of the laws: rounding must not choose a side.
stockwork_same_test(NAME parallel/turned_in_situ DECK tests/data/turned_in_situ.prm
  RANKS 1,2 TOLERANCE 1e-8 IGNORE balance_error)
