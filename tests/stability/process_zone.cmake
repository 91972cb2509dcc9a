# (f) A process zone of a fifth of a cell (K_I/T = 1/3 m^0.5, cells of 0.5 m): cohesive cracks are held back. Cohesive cracks
# with a strength that it resolves, and `damage`, which lowers the strength itself.
set(strong "Resolution=coarse" "Time/End time=5 s" "Output/Fields=false")
stockwork_case_test(NAME stability/f/unresolved/fails DECK prm/kgd/toughness/cohesive_xfem.prm
  SET ${strong} "Rock/Tensile strength=3 MPa" EXPECT "errors/net_inlet_pressure/mean > 0.5" # 0.888
  WARNS "is not resolved by cells of 0.5 m")
stockwork_case_test(NAME stability/f/weaker DECK prm/kgd/toughness/cohesive_xfem.prm
  SET ${strong} "Rock/Tensile strength=1 MPa" EXPECT "errors/net_inlet_pressure/mean < 0.06") # 0.040
stockwork_case_test(NAME stability/f/lowered DECK prm/kgd/toughness/damage.prm
  SET ${strong} "Rock/Tensile strength=3 MPa" EXPECT "errors/net_inlet_pressure/mean < 0.2" # 0.130
  WARNS "it is lowered to")
# The stress of the cells beside the tip alone draws it to the lines of the mesh, from 30 degrees.
foreach(radius 1 5)
  set(expect "direction < 27.5") # 26.5
  set(name fails)
  if(radius EQUAL 5)
    set(expect "direction > 29" "direction < 31") # 29.6
    set(name five_cells)
  endif()
  stockwork_case_test(NAME stability/f/direction/${name} DECK prm/kgd/rotated/30/damage.prm
    SET "Resolution=coarse" "Time/End time=3 s" "Output/Fields=false" "Fracture/damage/Direction radius=${radius}"
    EXPECT ${expect})
endforeach()
