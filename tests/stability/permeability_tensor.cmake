# (i) A fracture's fluid in the elements of the pore pressure. In tight rock, sqrt(c t) far below a cell, half of it is held
# by the rock beside the fracture, where nothing flows.
set(tight "Resolution=coarse" "Time/End time=0.5 s" "Rock/Permeability=1e-17 m^2" "Output/Fields=false")
set(deck prm/kgd/sun/permeable/damage.prm)
stockwork_case_test(NAME stability/i/tight_rock/fails DECK ${deck}
  SET ${tight} "Fracture/damage/Fluid=permeability tensor" EXPECT "final/fracture_volume < 2.6e-5") # of 5e-5 m^2
stockwork_case_test(NAME stability/i/tight_rock/network DECK ${deck}
  SET ${tight} "Fracture/damage/Fluid=network" EXPECT "final/fracture_volume = final/injected_volume within 2e-3")
# A slot at 30 degrees to the mesh, 140 Pa along it: below the least pressure that is given, 0, there is none.
stockwork_case_test(NAME stability/i/undershoot/fails DECK prm/stability/slot/30/damage.prm
  SET "Output/Fields=true" EXPECT "fields/pore_pressure/minimum < -0.5") # -0.95
stockwork_case_test(NAME stability/i/undershoot/network DECK prm/stability/slot/30/damage.prm
  SET "Output/Fields=true" "Fracture/damage/Fluid=network" EXPECT "fields/pore_pressure/minimum > -1e-9")
