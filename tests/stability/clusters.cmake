# (j) Two equal clusters on one well, whose stresses differ by 82 kPa in 20 MPa. Without friction one takes all.
set(noise "In situ/Stress gradient=1e4, 1e4" "Output/Fields=false")
stockwork_case_test(NAME stability/j/without_friction/fails DECK prm/stability/equal_clusters/cohesive_xfem.prm
  SET ${noise} "Wells/Well 1/Perforation friction=0"
  EXPECT "final/well_1_perforation_1_rate > 4.5e-4" "final/well_1_perforation_2_rate < 0.5e-4") # 4.90, 0.10 of 5
stockwork_case_test(NAME stability/j/friction DECK prm/stability/equal_clusters/cohesive_xfem.prm
  SET ${noise} EXPECT "final/well_1_perforation_1_rate = final/well_1_perforation_2_rate within 0.02") # 0.0102
