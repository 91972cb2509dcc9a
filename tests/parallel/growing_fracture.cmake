# A growing fracture with refinement around its tip.
foreach(ranks 2 4)
  stockwork_same_test(NAME parallel/growing_fracture_${ranks} DECK tests/data/growing_fracture.prm
    RANKS 1,${ranks} TOLERANCE 1e-8 IGNORE balance_error)
endforeach()
