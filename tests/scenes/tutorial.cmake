# The minifrac of doc/tutorial.

# What the scene audit says of a minifrac before it runs: --check prints it and solves nothing.
function(stockwork_audit_test name says)
  stockwork_check_test(NAME scenes/audit/${name} DECK prm/tutorial/cohesive_xfem.prm SAYS "${says}" LABELS quick ${ARGN})
endfunction()

# The run has 0.XX.
stockwork_audit_test(efficiency "efficiency at shut-in +0\\.35.*after 720 s of pumping"
  WITHOUT "Warning: (cell|distance)")
# Half the coefficient of Carter that the rock has: less leaks off.
stockwork_audit_test(efficiency_carter "efficiency at shut-in +0\\.[4-6]"
  SET "Fracture flow/Leak-off=carter" "Fracture flow/Carter coefficient=1e-5 m/s^0.5")
stockwork_audit_test(no_leak_off "distance to walls" WITHOUT "efficiency"
  SET "Fracture flow/Leak-off=none")
stockwork_audit_test(not_shut_in "efficiency at the end .*the well is not shut in"
  SET "Wells/Well 1/Rate=0.04 bbl/min/m")
# A hundredth of the permeability: the fluid comes 0.15 m into the rock, and cells are 1 m.
stockwork_audit_test(cells_exceed_diffusion "Warning: cell size / sqrt.c t. = 6\\.[0-9]+: .* too little leaks off"
  SET "Rock/Permeability=0.015 md")
stockwork_audit_test(near_walls "Warning: distance to walls / final length = [34]\\."
  SET "Mesh/Box/Lower corner=-90 m, -90 m" "Mesh/Box/Upper corner=90 m, 90 m")

# A pressure that the deck gives, beside the stress that holds the crack shut: that at 30 degrees of 10 and 20 MPa, 17.5.
stockwork_check_test(NAME scenes/audit/given_pressure DECK tests/data/pressed_crack.prm LABELS quick
  SET "In situ/Stress=-10 MPa, -20 MPa" SAYS "given pressure / in-situ stress across a crack +0\\.686 +the least, of 1\\.75e.07 Pa: no crack of the deck opens")

# Beside the one with which a crack grows: the roots of the static G/G_c, 1.8 and 0.37 (doc/cases/dry.md).
stockwork_check_test(NAME scenes/audit/growth_under_given_pressure DECK prm/dry/bridge/1/peridynamics.prm LABELS quick
  SAYS "net pressure given / needed for growth +1\\.36 +crack 1 grows, the longer it is the more easily, until walls")
stockwork_check_test(NAME scenes/audit/no_growth_under_given_pressure DECK prm/dry/bridge/0.45/peridynamics.prm LABELS quick
  SAYS "net pressure given / needed for growth +0\\.611 +crack 1 comes nearest to it; by statics and alone in a large rock it does not grow")
# Shear along a natural crack at 60 degrees under 2 and 1 MPa: sin 120 / 2 = 0.433 MPa, beside 1.75 MPa across it.
stockwork_check_test(NAME scenes/audit/shear_along_a_crack DECK prm/natural_crack/60/cohesive_xfem.prm LABELS quick
  SAYS "in-situ shear stress along a crack .Pa. +4\\.33e.05 +crack 2: 1\\.75e.06 Pa presses its faces; with a friction coefficient of less than 0\\.247 it slides")
stockwork_check_test(NAME scenes/audit/nothing_presses_faces DECK prm/natural_crack/cohesive_xfem.prm LABELS quick
  SET "In situ/Stress=-2 MPa, -1 MPa" "Cracks/Open=2 m, -1 m -> 3.1547 m, 1 m"
      "Wells/Well 1/Perforations=2.57735 m, 0" "Wells/Well 1/Fraction in model=1"
  SAYS "in-situ shear stress along a crack .Pa. +4\\.33e.05 +crack 1: its fluid is at the stress across it, for the rock has no pores")

# The whole hour. The stress across the fracture is 18.00 MPa in situ; contrib/back_stress.py reads
# 18.17 MPa beside it 30 s before it closes. Greatest aperture: 0.907 mm.
stockwork_case_test(NAME scenes/tutorial/resolved DECK prm/tutorial/cohesive_xfem.prm LABELS nightly TIMEOUT 1800
  EXPECT "closure/first_contact = 18.17e6 within 0.02" "closure/g_function = 18.17e6 within 0.02"
         "minimum/minimum_aperture > -9.07e-6" "maximum/maximum_aperture > 8.6e-4" "minimum/minimum_pressure > 13.4e6"
         "fluid_balance/relative_error < 1e-8")
# Its first seconds: faces that come to touch, and part, neither press fluid out of the fracture nor suck it in. The
# pores are at 13.5 MPa.
stockwork_case_test(NAME scenes/tutorial/start DECK prm/tutorial/cohesive_xfem.prm LABELS quick
  SET "Time/End time=6 s" "Output/Fields=false"
  EXPECT "minimum/minimum_pressure > 13.4e6" "minimum/minimum_aperture > -0.76e-6" "maximum/maximum_aperture > 1.5e-4")
stockwork_scene_test(tutorial/one_cell DECK prm/tutorial/cohesive_xfem.prm LABELS quick
  ARGS --set "Cracks/Open=-0.4, 0.3 -> 0.6, 0.4" --set "Wells/Well 1/Perforations=0.1, 0.35" --checked --ends 1
       --says "a crack through two cells or more")
stockwork_scene_test(tutorial/sheared DECK prm/tutorial/cohesive_xfem.prm LABELS quick
  ARGS --set "In situ/Stress=-18 MPa, -18 MPa, 25 MPa" --checked --ends 1 --says "a tension of")
stockwork_case_test(NAME scenes/tutorial/carter DECK prm/tutorial/carter/cohesive_xfem.prm LABELS nightly TIMEOUT 1800
  EXPECT "closure/first_contact = 18e6 within 0.02" "closure/g_function = 18e6 within 0.02"
         "minimum/minimum_aperture > -9.07e-6" "fluid_balance/relative_error < 1e-8")
# With bonds, whose path is that of the stress, 25 degrees: as far, and as fast, as with cut cells.
stockwork_case_test(NAME scenes/tutorial/path DECK prm/tutorial/peridynamics.prm LABELS nightly TIMEOUT 1800
  EXPECT "closure/first_contact = 18.17e6 within 0.005" "closure/g_function = 18.17e6 within 0.005"
         "closure/isip = 18.466e6 within 0.005" "minimum/minimum_aperture > -9.07e-6" "maximum/inlet_aperture = 9.07e-4 within 0.04"
         "maximum/equivalent_length = 43.9 within 0.06" "fluid_balance/relative_error < 1e-8")
stockwork_scene_test(tutorial/bonds DECK prm/tutorial/cohesive_xfem.prm LABELS quick
  ARGS --set "Fracture/Model=peridynamics" --set "Discretisation/Elements=Q1-Q1 stabilised" --set "Fracture/peridynamics/Closure=conserving"
       --checked --ends 1 --says "In situ/Stress: along the crack" --says "and hold 0.762 MPa with cells of 1 m"
       --says "Use 'Fracture/peridynamics/Closure = in bonds'")
stockwork_check_test(NAME scenes/tutorial/bonds/chosen DECK prm/tutorial/cohesive_xfem.prm
  SET "Fracture/Model=peridynamics" "Discretisation/Elements=Q1-Q1 stabilised"
  SAYS "Closure = in bonds: for a path.*Tracking = path: the crack .* is oblique to the mesh")
