# A recording of pendulum.robot with ZZ 0.5, mX 1, mY 0.1, Fs 0.4, Fv 0.2: four periods of 4 s at 200 Hz.
BEGIN {
  srand(1)
  print "time,q1,tau1"
  w = 2 * atan2(0, -1) / 4
  for (k = 0; k <= 3200; ++k) {
    t = k / 200
    q = sin(w * t) + 0.5 * sin(2 * w * t + 0.7) + 0.2 * sin(5 * w * t)
    dq = w * (cos(w * t) + cos(2 * w * t + 0.7) + cos(5 * w * t))
    ddq = -w * w * (sin(w * t) + 2 * sin(2 * w * t + 0.7) + 5 * sin(5 * w * t))
    sign = dq > 0 ? 1 : dq < 0 ? -1 : 0
    # about normal: the sum of twelve uniform numbers
    noise = -6
    for (i = 0; i < 12; ++i) noise += rand()
    printf "%.3f,%.9f,%.6f\n", t, q, 0.5 * ddq + 9.81 * (sin(q) * 1 + cos(q) * 0.1) + 0.4 * sign + 0.2 * dq + 0.02 * noise
  }
}
