# (d) The cubic law from a shut crack, which is to be filled in one step: 1 mm^2 for each metre of 20.
set(deck prm/stability/cold_start/prescribed.prm)
set(boundless "Nonlinear solver/Maximum pressure change=1000 GPa")
stockwork_stop_test(NAME stability/d/cold_start/fails DECK ${deck}
  SET ${boundless} "Time/Minimum step=1 s" SAYS "no convergence in 25 iterations" "the balance of fluid in the fracture is left")
stockwork_case_test(NAME stability/d/cold_start/cut_step DECK ${deck}
  SET ${boundless} EXPECT "rejected_steps == 1" "steps == 2" "fluid_balance/relative_error < 1e-8")
stockwork_case_test(NAME stability/d/cold_start/shorter_iterations DECK ${deck} # 20 iterations
  SET "Time/Minimum step=1 s" "Nonlinear solver/Maximum pressure change=10 MPa"
  EXPECT "steps == 1" "rejected_steps == 0" "fluid_balance/relative_error < 1e-8")
# What is not a cure: with a minimum aperture of 1 mm it converges at once, to a tenth of the pressure.
stockwork_case_test(NAME stability/d/cold_start/wide_floor_is_wrong DECK ${deck}
  SET ${boundless} "Time/Minimum step=1 s" "Fracture flow/Minimum aperture=1 mm"
  EXPECT "nonlinear_iterations < 5" "final/inlet_pressure < 0.1e6") # 0.081 MPa for 0.935 MPa
