# (c) Newmark's method. What is unstable is refused: gamma < 1/2, and 2 beta < gamma (errors/unstable_newmark).
# A sudden load makes the finest mesh ring, and gamma = 1/2 lets it: tension where nothing has arrived, in shares of the load.
set(deck prm/stability/sudden_load/none.prm)
set(sudden "Resolution=medium" "Time/Newmark beta=0.5625")
stockwork_case_test(NAME stability/c/ringing/fails DECK ${deck}
  SET ${sudden} "Time/Newmark gamma=0.5" EXPECT "fields/total_stress/maximum > 0.2") # 0.356
stockwork_case_test(NAME stability/c/ringing/damped DECK ${deck}
  SET ${sudden} "Time/Newmark gamma=1" EXPECT "fields/total_stress/maximum < 0.01") # 0.0006
# The price, on a smooth wave: energy that is lost, of what was put in.
set(smooth "Resolution=medium" "Output/Fields=false" "Time/Initial step=5 ms" "Time/End time=0.2 s")
stockwork_case_test(NAME stability/c/smooth_wave/damped_fails DECK prm/bar_wave/none.prm
  SET ${smooth} "Time/Newmark gamma=1" "Time/Newmark beta=0.5625" EXPECT "final/energy_balance_error > 0.05") # 0.105
stockwork_case_test(NAME stability/c/smooth_wave/undamped DECK prm/bar_wave/none.prm
  SET ${smooth} EXPECT "final/energy_balance_error < 1e-11")
