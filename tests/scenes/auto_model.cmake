# 'Fracture/Model = auto' and 'Resolution = auto': what is chosen keeps the promise, and what no chart covers is refused.
stockwork_case_test(NAME scenes/model/chosen DECK tests/scenes/auto_model.prm
  EXPECT "errors/equivalent_length/final < 0.02" "errors/inlet_aperture/final < 0.02" "errors/net_inlet_pressure/final < 0.02")

# stockwork_choice_test(NAME text that is said SET ...)
function(stockwork_choice_test name status says)
  stockwork_scene_test(model/${name} DECK tests/scenes/auto_model.prm
    ARGS --checked --ends ${status} --says "${says}" ${ARGN})
endfunction()

function(stockwork_choice_said_test name says)
  stockwork_check_test(NAME scenes/model/${name} DECK tests/scenes/auto_model.prm SAYS "${says}" SET ${ARGN})
endfunction()

stockwork_choice_said_test(cheapest "Fracture/Model = damage, Resolution = coarse: the cheapest .*second choice cohesive_xfem, coarse" "Accuracy=3 %")
# A promise is half as much again as the chart's error, and has to be within the accuracy.
stockwork_choice_said_test(margin "Fracture/Model = cohesive_xfem, Resolution = coarse: .*at most 1.7 %: 1.1 % at the end.*not damage: coarse promises 2.6 %")
stockwork_choice_said_test(more_accurate "Fracture/Model = cohesive_xfem, Resolution = medium" "Accuracy=1.2 %")
stockwork_choice_said_test(model_given "Fracture/Model = cohesive_xfem, Resolution = coarse" Fracture/Model=cohesive_xfem)
stockwork_choice_said_test(resolution_given "Fracture/Model = damage, Resolution = medium" Resolution=medium "Accuracy=3 %")
# Where viscosity dominates, bonds hold by the stress in situ, which charts do not know: never them. In between both
# neighbours have to promise.
stockwork_choice_said_test(viscous "Fracture/Model = cohesive_xfem, Resolution = coarse"
  "Rock/Fracture toughness=0.01 MPa m^0.5" "Fluid/Viscosity=1e-3 Pa s" Time/Scheme=BDF2)
stockwork_choice_test(viscous_first_order 1 "charts of that are with 'Time/Scheme = BDF2'"
  --set "Rock/Fracture toughness=0.01 MPa m^0.5" --set "Fluid/Viscosity=1e-3 Pa s")
stockwork_choice_said_test(between "the charts of 'growing' with K_m = 2 to 2.2 and 'growing' with K_m = 7.2" "Fluid/Viscosity=1e-5 Pa s"
  "Accuracy=4 %")
stockwork_choice_test(bonds_in_viscous_fluid 1 "charts of this kind of scene show doing well, which 'peridynamics' is not"
  --set "Fracture/Model=peridynamics" --set "Rock/Fracture toughness=0.01 MPa m^0.5" --set "Fluid/Viscosity=1e-3 Pa s"
  --set Time/Scheme=BDF2)
# What no chart covers.
stockwork_choice_test(too_accurate 1 "not cohesive_xfem: coarse promises" --says "% is: "
  --set "Accuracy=0.01 %")
stockwork_choice_test(permeable 1 "no chart for rock with pore pressure whose leak-off is not resolved"
  --set "Rock/Bulk model=poroelastic" --set "Rock/Permeability=1e-15" --set "Fluid/Bulk modulus=2 GPa")
stockwork_choice_test(stress_at_an_angle 1 "the stress in situ shears the crack"
  --set "In situ/Stress=-10 MPa, -10 MPa, 2 MPa")
stockwork_choice_test(stress_across 1 "the stress in situ is greatest across the crack"
  --set "In situ/Stress=-17 MPa, -23 MPa")
stockwork_choice_test(strength_given 1 "the deck gives a tensile strength" --set "Rock/Tensile strength=20 MPa")
stockwork_choice_test(loaded 1 "there are loads on the boundary" --set "Boundary conditions/Normal traction=top: -6 MPa"
  --set "Boundary conditions/Roller=left, bottom")
stockwork_choice_test(walls 1 "the walls are nearer" --set "Mesh/Box/Lower corner=0, -32 m" --set "Mesh/Box/Upper corner=32 m, 32 m")
stockwork_choice_said_test(held "Fracture/Model = cohesive_xfem, .*not damage: coarse has 'Fracture/damage/Growth = false'"
  "Fracture/damage/Growth=false")
stockwork_choice_said_test(other_elements "not cohesive_xfem: coarse has 'Discretisation/Elements = Q1-Q1'"
  "Discretisation/Elements=Q1-Q1")
stockwork_choice_test(wide_at_least 1 "is more than a twentieth of what the fracture opens by" --set "Fracture flow/Minimum aperture=0.1 mm")
stockwork_choice_test(incompressible 1 "Poisson's ratio is above 0.4" --set "Rock/Poisson ratio=0.45")
stockwork_choice_test(long_crack 1 "more than half as long as its fracture would be" --set "Cracks/Open=0, 0 -> 19 m, 0")
stockwork_choice_test(rate_of_an_expression 1 "the well's rate changes in time" --set Verification/Reference=none
  --set "Wells/Well 1/Rate=f(t) = 1e-4*(1 + 0.9*sin(t))")
stockwork_choice_test(cavitating 1 "the fluid may cavitate" --set "Fracture flow/Vapour pressure=-1 kPa")
stockwork_choice_test(compressible 1 "the net pressure compresses the fluid" --set "Fluid/Bulk modulus=1 MPa")
stockwork_choice_test(moving 1 "inertia is on" --set "Time/Inertia=on" --set "Rock/Density=2500")

# More leaks off than in any chart.
stockwork_choice_test(leaks_more 1 "of the fluid leaks off, and charts of 'growing, carter' have up to 58 %"
  --set "Verification/Reference=none" --set "Fracture flow/Leak-off=carter" --set "Fracture flow/Carter coefficient=1e-4 m/s^0.5")

# A notch whose tips will run into larger cells than those around its middle: what counts is the cells on the way. With
# cells alike as far as the fracture runs there is a choice, and cells count for what they are.
stockwork_scene_test(model/larger_cells_ahead DECK tests/scenes/auto_model_turned.prm
  ARGS --checked --ends 1 --says "not cohesive_xfem: coarse has 4.66 cells in the half length, fewer than any chart")
stockwork_scene_test(model/cells_alike_ahead DECK tests/scenes/auto_model_turned.prm
  ARGS --checked --ends 0 --says "Fracture/Model = cohesive_xfem, Resolution = coarse" --says "here are 21.3"
       --set "Mesh/Box/X spacing={0.2|0.1|0.05} m from -5.7 m to 5.7 m, growth 1.25"
       --set "Mesh/Box/Y spacing={0.2|0.1|0.05} m from -5.7 m to 5.7 m, growth 1.25")
stockwork_scene_test(model/cells_ahead_said DECK tests/scenes/auto_model_turned.prm
  ARGS --checked --ends 0 --set Resolution=coarse --set Fracture/Model=cohesive_xfem
       --says "the fracture will stop the run where larger cells than about")

# To 60 s the choice is medium, to 100 s coarse: a restart to 100 s goes on with what there is. (Fields, for a step that
# ends at 60 s.)
stockwork_restart_test(NAME scenes/model/restart DECK tests/scenes/auto_model.prm TOLERANCE 1e-8 LABELS nightly
  IGNORE "fluid_balance_error|error_fracture_volume" SET "Resolution=medium" "Output/Fields=true" "Output/Times of fields=60 s" INTERRUPT_SET "Resolution=auto" "Time/End time=60 s" "Checkpoint/Steps between=1"
  RESTART_SET "Resolution=auto")

# A crack that does not grow. Growing under its pressure, it is in no chart.
stockwork_case_test(NAME scenes/model/static DECK tests/scenes/auto_model_static.prm
  EXPECT "errors/fracture_volume/final < 0.005" "errors/displacement/final < 0.005")
stockwork_scene_test(model/growing_under_pressure DECK tests/scenes/auto_model_static.prm
  ARGS --checked --ends 1 --says "the given pressure lets the crack grow" --set "Cracks/Fluid pressure=10 MPa")

# Porous rock, whose leak-off is resolved, in a wide domain: the impermeable charts of this toughness have to promise as well.
stockwork_scene_test(model/porous DECK prm/kgd/sun/permeable/damage.prm
  ARGS --checked --ends 0 --set "Fracture/Model=auto" --set "Resolution=auto" --set "Accuracy=5.5 %"
       --set "Mesh/Box/Lower corner=0, -80 m" --set "Mesh/Box/Upper corner=80 m, 80 m"
       --set "Mesh/Box/X spacing={0.2|0.1|0.05} m from 0 m to 8 m, growth 1.3"
       --set "Mesh/Box/Y spacing={0.2|0.1|0.05} m around 0 m, growth 1.3"
       --says "the charts of 'growing' with K_m = 2 to 2.2 and 'growing, porous' with K_m = 2.2"
       --says "Fracture/Model = damage, Resolution = medium")

# Discs that grow have one model: the second choice is the next resolution.
stockwork_scene_test(model/disc DECK prm/radial/toughness/damage.prm
  ARGS --checked --ends 0 --set "Fracture/Model=auto" --set "Resolution=auto" --set "Accuracy=6 %"
       --says "Fracture/Model = damage, Resolution = coarse" --says "second choice damage, medium")
stockwork_scene_test(model/disc_leaks DECK prm/radial/carter/damage.prm
  ARGS --checked --ends 1 --set "Fracture/Model=auto" --set "Resolution=coarse" --says "nothing tells how long the fracture will be")

# A solver that is none for a small scene.
stockwork_scene_test(slow_solver DECK prm/kgd/sun/damage.prm
  ARGS --checked --ends 0 --set "Linear solver/Type=direct" --says "Linear solver/Type = direct: set 'auto'")
stockwork_scene_test(slow_solver/disc DECK prm/radial/small/damage.prm
  ARGS --checked --ends 0 --set "Linear solver/Type=iterative" --says "Linear solver/Type = iterative: set 'auto'")
# Where nothing is left to the program.
stockwork_check_test(NAME scenes/model/idle_accuracy DECK prm/kgd/toughness/damage.prm LABELS quick
  SET Resolution=coarse "Accuracy=1 %" SAYS "Warning: 'Accuracy = 1 %' is without effect")
