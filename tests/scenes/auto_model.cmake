# 'Fracture/Model = auto' and 'Resolution = auto': what is chosen keeps the promise, and what no chart covers is refused.
stockwork_case_test(NAME scenes/model/chosen DECK tests/scenes/auto_model.prm
  EXPECT "errors/equivalent_length/final < 0.02" "errors/inlet_aperture/final < 0.02" "errors/net_inlet_pressure/final < 0.02")

# stockwork_choice_test(NAME text that is said SET ...)
function(stockwork_choice_test name status says)
  stockwork_scene_test(model/${name} DECK tests/scenes/auto_model.prm
    ARGS --checked --ends ${status} --says "${says}" ${ARGN})
endfunction()

function(stockwork_choice_said_test name says)
  if(TARGET stockwork_program)
    add_test(NAME scenes/model/${name} COMMAND stockwork_program ${CMAKE_CURRENT_SOURCE_DIR}/auto_model.prm --check ${ARGN})
    set_tests_properties(scenes/model/${name} PROPERTIES LABELS scenes TIMEOUT 120 PASS_REGULAR_EXPRESSION "${says}")
  endif()
endfunction()

stockwork_choice_said_test(cheapest "Fracture/Model = damage, Resolution = coarse: the cheapest .*second choice cohesive_xfem, coarse")
stockwork_choice_said_test(more_accurate "Fracture/Model = cohesive_xfem, Resolution = medium" --set "Accuracy=0.8 %")
stockwork_choice_said_test(model_given "Fracture/Model = cohesive_xfem, Resolution = coarse" --set Fracture/Model=cohesive_xfem)
stockwork_choice_said_test(resolution_given "Fracture/Model = damage, Resolution = medium" --set Resolution=medium)
# Where viscosity dominates, bonds fail: never them. In between both neighbours have to promise.
stockwork_choice_said_test(viscous "Fracture/Model = cohesive_xfem, Resolution = coarse.*shown failing: 'peridynamics .kgd/viscosity.'"
  --set "Rock/Fracture toughness=0.01 MPa m^0.5" --set "Fluid/Viscosity=1e-3 Pa s")
stockwork_choice_said_test(between "the charts of 'toughness' and 'transitional'" --set "Fluid/Viscosity=1e-5 Pa s"
  --set "Accuracy=4 %")
stockwork_choice_test(bonds_in_viscous_fluid 1 "no chart of this kind of scene shows 'peridynamics' doing well"
  --set "Fracture/Model=peridynamics" --set "Rock/Fracture toughness=0.01 MPa m^0.5" --set "Fluid/Viscosity=1e-3 Pa s")
# What no chart covers.
stockwork_choice_test(too_accurate 1 "promises 0.35 %" --set "Accuracy=0.01 %")
stockwork_choice_test(permeable 1 "no chart covers this scene, for the rock has a pore pressure"
  --set "Rock/Bulk model=poroelastic" --set "Rock/Permeability=1e-15" --set "Fluid/Bulk modulus=2 GPa")
stockwork_choice_test(stress_at_an_angle 1 "the stress in situ shears the crack"
  --set "In situ/Stress=-10 MPa, -10 MPa, 2 MPa")
stockwork_choice_test(stress_across 1 "the stress in situ is greatest across the crack"
  --set "In situ/Stress=-17 MPa, -23 MPa")
stockwork_choice_test(strength_given 1 "the deck gives a tensile strength" --set "Rock/Tensile strength=20 MPa")
stockwork_choice_test(loaded 1 "there are loads on the boundary" --set "Boundary conditions/Normal traction=top: -6 MPa"
  --set "Boundary conditions/Roller=left, bottom")
stockwork_choice_test(walls 1 "the walls are nearer" --set "Mesh/Box/Lower corner=0, -32 m" --set "Mesh/Box/Upper corner=32 m, 32 m")
stockwork_choice_said_test(held "Fracture/Model = cohesive_xfem, .*damage, coarse has 'Fracture/damage/Growth = false'"
  --set "Fracture/damage/Growth=false")
stockwork_choice_test(moving 1 "inertia is on" --set "Time/Inertia=on" --set "Rock/Density=2500")

# A crack that does not grow. Growing under its pressure, it is in no chart.
stockwork_case_test(NAME scenes/model/static DECK tests/scenes/auto_model_static.prm
  EXPECT "errors/fracture_volume/final < 0.005" "errors/displacement/final < 0.005")
stockwork_scene_test(model/growing_under_pressure DECK tests/scenes/auto_model_static.prm
  ARGS --checked --ends 1 --says "the given pressure lets the crack grow" --set "Cracks/Fluid pressure=10 MPa")
