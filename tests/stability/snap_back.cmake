# (g) A cracked bar beyond 2 E'G_c/T^2 = 1 m, T = 2.53 MPa, cannot be pulled apart by its end; by what the crack opens, it can.
stockwork_stop_test(NAME stability/g/end/fails DECK prm/stability/snap_back/end/damage.prm
  SAYS "fails even with the shortest step allowed" "the balance of forces on the fracture's faces is left")
stockwork_case_test(NAME stability/g/end/weaker DECK prm/stability/snap_back/end/damage.prm
  SET "Rock/Tensile strength=2.4 MPa" EXPECT "final/dissipated_energy = 50 within 1e-9" "final/energy_balance_error < 1e-3")
stockwork_case_test(NAME stability/g/opening DECK prm/stability/snap_back/opening/damage.prm
  EXPECT "final/dissipated_energy = 50 within 1e-9" "final/energy_balance_error < 1e-3" "rejected_steps == 0")
