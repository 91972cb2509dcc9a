# Wells that open into the rock: the pressure around them and in their boreholes.
stockwork_case_test(NAME convergence/drawdown DECK prm/drawdown/none.prm NEGATIVE LABELS quick
  SET "Resolution=coarse" "Output/Fields=false"
  EXPECT "errors/pore_pressure/final < 0.04" "errors/displacement/final < 4e-3"
         "errors/well_1_borehole_pressure/final < 6e-4" "errors/well_1_borehole_pressure/mean < 1.2e-3"
         "fluid_balance/relative_error < 1e-12")
# The hill of pressure within the source is not Theis's, and the source shrinks with the cells.
stockwork_order_test(NAME convergence/order/drawdown DECK prm/drawdown/none.prm
  SET "Output/Fields=false" SERIES "Resolution=coarse" "Resolution=medium"
  ORDER "errors/displacement/final=2" "errors/pore_pressure/final=1")
# What the run does not know is said: that the rock would break, in situ or at the well.
stockwork_case_test(NAME convergence/drawdown/fractures DECK prm/drawdown/none.prm LABELS quick
  SET "Resolution=coarse" "Output/Fields=false" "Time/End time=10 min" "Wells/Well 1/Rate=5e-4"
      "In situ/Stress=-12 MPa, -9 MPa"
  WARNS "least compressive stress = 1.11: the pores would open fractures" "it would fracture the rock")
# After the pump has stopped (Horner 1951: the sum of two such solutions).
stockwork_case_test(NAME convergence/drawdown/shut_in DECK tests/data/well_shut_in.prm NEGATIVE
  SET "Resolution=coarse" "Output/Fields=false"
  EXPECT "errors/pore_pressure/final < 0.025" "errors/displacement/final < 6e-3"
         "errors/well_1_borehole_pressure/final < 2e-4" "fluid_balance/relative_error < 1e-12")
# At a point.
stockwork_case_test(NAME convergence/drawdown/point DECK prm/drawdown/point/none.prm NEGATIVE
  SET "Resolution=coarse" "Output/Fields=false"
  EXPECT "errors/displacement/final < 0.035" "errors/well_1_borehole_pressure/final < 1.5e-3"
         "errors/well_1_borehole_pressure/mean < 3e-3" "fluid_balance/relative_error < 1e-12")

# Steady: 4.430148 MPa by Thiem (1906). Wherever the well is in its cell, with cells halved, and with
# the fluid spread over twice the radius.
set(deck tests/data/drained_disc.prm)
stockwork_case_test(NAME convergence/well/steady DECK ${deck} LABELS quick
  EXPECT "final/well_1_borehole_pressure = 4.430148e6 within 5e-4"
         "fluid_balance/relative_error < 1e-12" "final/fluid_volume_defect < 1e-6"
         "final/fluid_volume_defect > -1e-6")
stockwork_case_test(NAME convergence/well/steady/wide DECK ${deck} LABELS quick
  SET "Resolution=medium" "Wells/Well 1/Source radius=25 m"
  EXPECT "final/well_1_borehole_pressure = 4.430148e6 within 5e-4")
# Given the pressure, the rate is that.
stockwork_case_test(NAME convergence/well/steady/pressure DECK ${deck} LABELS quick
  SET "Wells/Well 1/Control=pressure" "Wells/Well 1/Rate=" "Wells/Well 1/Pressure=4.430148 MPa"
  EXPECT "final/well_1_rate = -1.25e-5 within 5e-4")
# Off the middle of a box, in layered and in isotropic rock: 8.123371 and 9.022446 MPa by Green's function of the
# rectangle at the radius of the borehole (the layered one stretched to isotropic rock of 5 md). Wherever
# the point is in its cell, and with cells halved.
set(deck tests/data/layered_box.prm)
set(isotropic "Rock/Permeability across the layers=" "Rock/Normal of the layers=")
stockwork_case_test(NAME convergence/well/box/layered DECK ${deck} LABELS quick
  EXPECT "final/well_1_borehole_pressure = 8.123371e6 within 1e-4")
stockwork_case_test(NAME convergence/well/box/layered/halved DECK ${deck} LABELS quick
  SET "Resolution=medium"
  EXPECT "final/well_1_borehole_pressure = 8.123371e6 within 1e-4")
stockwork_case_test(NAME convergence/well/box DECK ${deck} LABELS quick SET ${isotropic}
  EXPECT "final/well_1_borehole_pressure = 9.022446e6 within 1e-4")
stockwork_case_test(NAME convergence/well/box/iterative DECK ${deck} LABELS quick
  SET ${isotropic} "Linear solver/Type=iterative"
  EXPECT "final/well_1_borehole_pressure = 9.022446e6 within 1e-4")

# Beside a fracture that grows; one that comes near says so. Nothing is lost, whoever solves it.
set(deck tests/data/wells_in_rock.prm)
# Of a fluid that is incompressible, volumes add up; a borehole stores none of it.
stockwork_case_test(NAME convergence/well/mixed DECK ${deck}
  SET "Fluid/Bulk modulus=inf" "Wells/Well 2/Borehole volume=0"
  WARNS "'Well 3' gives less than it should"
  EXPECT "fluid_balance/relative_error < 1e-10" "final/fluid_volume_defect < 1e-12"
         "final/fluid_volume_defect > -1e-12" "final/well_2_rate == 0"
         "final/well_3_borehole_pressure = 2e6 within 1e-8" "final/fracture_length > 3.4")
stockwork_case_test(NAME convergence/well/mixed/split DECK ${deck}
  SET "Coupling/Scheme=fixed stress" "Time/End time=3 s"
  EXPECT "fluid_balance/relative_error < 1e-8" "final/well_2_borehole_pressure > 2e7")
stockwork_case_test(NAME convergence/well/reached DECK ${deck}
  SET "Wells/Well 2/Perforations=12, 5.5" "Wells/Well 1/Rate=5e-4" "Time/End time=6 s"
  WARNS "a fracture has come into the rock about the well 'Well 2'"
  EXPECT "fluid_balance/relative_error < 1e-10")
