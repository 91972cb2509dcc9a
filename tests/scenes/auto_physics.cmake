# 'Physics = auto': each decision twice, where it leaves something out (the reduced run agrees with the full one within
# what is stated, and does less), and where it must not.
# stockwork_physics_test(NAME [DECK deck] ARGS options of check_physics.py)
function(stockwork_physics_test name)
  cmake_parse_arguments(P "" "DECK" "ARGS;LABELS" ${ARGN})
  if(NOT TARGET stockwork_program)
    return()
  endif()
  if(NOT P_DECK)
    set(P_DECK tests/scenes/auto_physics.prm)
  endif()
  string(REPLACE "/" "." scratch physics/${name})
  add_test(NAME scenes/physics/${name} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/check_physics.py
    --program $<TARGET_FILE:stockwork_program> --scratch ${CMAKE_BINARY_DIR}/tests/runs/scenes.${scratch}
    --deck ${CMAKE_SOURCE_DIR}/${P_DECK} ${P_ARGS})
  set_tests_properties(scenes/physics/${name} PROPERTIES LABELS "scenes;${P_LABELS}")
endfunction()

set(moving --set "Time/Inertia=on" --set "Rock/Density=2500" --set "Time/Newmark gamma=0.6" --set "Time/Newmark beta=0.3025"
  --set "Time/Initial step=2 ms" --set "Time/Maximum step=10 ms" --set "Wells/Well 1/Rate=1e-2 m^2/s")
set(saturated --set "Rock/Bulk model=poroelastic" --set "Rock/Porosity=0.2" --set "Rock/Biot coefficient=0.7"
  --set "Fluid/Bulk modulus=2.2 GPa")
set(leaking ${saturated} --set "Fracture flow/Leak-off=resolved")
set(yielding --set "Rock/Law=mohr coulomb" --set "Rock/mohr coulomb/Cohesion=30 MPa"
  --set "Rock/mohr coulomb/Friction angle=30 deg" --set "Rock/mohr coulomb/Dilation angle=5 deg")

# A fracture that runs for 55 periods of its waves, and one for 28.
stockwork_physics_test(inertia ARGS ${moving} --set "Time/End time=0.8 s"
  --leaves-out inertia --less iterations=1.8)
stockwork_physics_test(inertia_kept ARGS ${moving} --set "Wells/Well 1/Rate=2e-2 m^2/s" --set "Time/End time=0.4 s"
  --keeps inertia --says "is more than 'Accuracy'")
stockwork_physics_test(inertia_kept/well ARGS ${moving} --set "Wells/Well 1/Control=pressure"
  --set "Wells/Well 1/Pressure=1 MPa" --set "Wells/Well 1/Rate=" --keeps inertia --says "acts at once")
# A bar that is pushed within a period, and within a hundred; its quasi-static end is that of the swinging bar within
# what the force gains in a period.
stockwork_physics_test(inertia_kept/wave DECK prm/bar_wave/none.prm ARGS --keeps inertia
  --says "loads change by 100 %")
stockwork_physics_test(inertia/slow DECK prm/bar_wave/none.prm ARGS --set "Resolution=coarse"
  --set "Boundary conditions/Normal traction=top: -1e4*t/30" --set "Verification/Reference=none"
  --set "Time/End time=30 s" --set "Time/Initial step=0.05 s" --leaves-out inertia --less iterations=0.99)

# Pores out of which next to nothing comes, and those that take a good deal.
stockwork_physics_test(pores ARGS ${leaking} --set "Rock/Permeability=1e-17"
  --leaves-out "pore pressure and its diffusion" --less unknowns=1.1 --says "Leak-off = none")
stockwork_physics_test(pores_kept ARGS ${leaking} --set "Rock/Permeability=1e-16"
  --keeps "pore pressure and its diffusion" --says "is more than 'Accuracy'")
# No leak-off, and a rim in which the rock drains.
stockwork_physics_test(pores/undrained ARGS ${saturated} --set "Rock/Permeability=1e-16"
  --leaves-out "pore pressure and its diffusion" --less unknowns=1.1)
stockwork_physics_test(pores_kept/incompressible ARGS ${saturated} --set "Rock/Permeability=1e-17"
  --set "Fluid/Bulk modulus=inf" --set "Boundary conditions/Drained=top" --keeps "pore pressure and its diffusion" --says "neither grains nor fluid")
# Bonds have Poisson's ratio 1/4: the program refuses the undrained rock.
stockwork_physics_test(pores_kept/bonds DECK prm/kgd/sun/peridynamics.prm ARGS ${saturated} --set "Resolution=coarse"
  --set "Rock/Permeability=1e-20" --set "Verification/Reference=none"
  --keeps "pore pressure and its diffusion" --says "without it the deck would be refused")

# Rock far from its strength, and rock nine tenths of whose strength the stress in situ takes.
stockwork_physics_test(plasticity ARGS ${yielding} --leaves-out plasticity --without rock)
stockwork_physics_test(plasticity_kept DECK prm/kgd/yielding/cohesive_xfem.prm ARGS --set "Resolution=coarse"
  --keeps plasticity)
stockwork_physics_test(plasticity_kept/no_strength ARGS ${yielding} --set "Rock/Tensile strength="
  --keeps plasticity --says "Rock/Tensile strength")
stockwork_physics_test(plasticity_kept/footing DECK prm/footing/bearing/none.prm ARGS --keeps plasticity)

stockwork_physics_test(inertia_kept/pulse DECK prm/bar_wave/none.prm ARGS --set "Resolution=coarse"
  --set "Boundary conditions/Normal traction=top: -1e4*if(abs(t-13.37)<0.01,1,0)" --set "Verification/Reference=none"
  --set "Time/End time=30 s" --set "Time/Initial step=0.005 s" --keeps inertia)

# All together: what has been left out makes room for more, or less.
stockwork_physics_test(pores_kept/yielding ARGS ${saturated} ${yielding} --set "Rock/mohr coulomb/Cohesion=2 MPa"
  --set "Rock/Permeability=1e-20" --keeps plasticity --keeps "pore pressure and its diffusion"
  --says "hangs on the effective stress")
stockwork_physics_test(all ARGS ${leaking} ${yielding} --set "Rock/Permeability=1e-18"
  --leaves-out plasticity --leaves-out "pore pressure and its diffusion" --less unknowns=1.1 --without rock)

# Where the deck gives no strength, the model's is that which it takes in the porous rock: the undrained rock is 11 %
# stiffer, and with a strength of its own the fracture would be 0.5 to 1.2 % longer, its broken part up to 6 %.
stockwork_physics_test(pores/strength DECK prm/kgd/sun/cohesive_xfem.prm ARGS ${saturated}
  --set "Rock/Permeability=1e-17" --set "Resolution=coarse" --set "Verification/Reference=none"
  --set "Time/End time=5 s" --leaves-out "pore pressure and its diffusion" --less unknowns=1.1
  --says "Rock/Tensile strength = ")

# A form of the flow with one pressure per fracture is not there.
stockwork_physics_test(gradients_kept DECK prm/kgd/toughness/cohesive_xfem.prm
  ARGS --keeps "pressure gradients along the fracture" --says "would make no step cheaper")

# The same decisions after an interruption, and what has been seen is not forgotten.
stockwork_restart_test(NAME scenes/physics/restart DECK tests/scenes/auto_physics.prm AFTER 15 TOLERANCE 1e-8 IGNORE fluid_balance_error
  SET "Physics=auto" "Time/End time=2 s" "Rock/Law=mohr coulomb" "Rock/mohr coulomb/Cohesion=30 MPa"
      "Rock/mohr coulomb/Friction angle=30 deg" "Rock/mohr coulomb/Dilation angle=5 deg")
stockwork_same_test(NAME scenes/physics/ranks DECK tests/scenes/auto_physics.prm RANKS 1,2 TOLERANCE 1e-6 IGNORE fluid_balance_error
  SET "Physics=auto" "Time/End time=1 s" "Rock/Law=mohr coulomb" "Rock/mohr coulomb/Cohesion=30 MPa"
      "Rock/mohr coulomb/Friction angle=30 deg" "Rock/mohr coulomb/Dilation angle=5 deg")
