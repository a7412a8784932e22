"""Frame, units and pure geometry; everything else in popsim is said in these terms.

**Frame.** Card frame, right-handed, millimetres. x runs along the central fold, y points to the ground side,
z bisects the interior fold angle (Sec. 3.3.2). The fold angle theta is pi with the card fully open and 0 with
it closed; alpha = theta / 2. Angles are radians inside popsim; files, tables and options speak degrees.

**Open pose.** A design is stored as it stands at theta = pi: the ground is the half plane z = 0, y > 0, the
backdrop z = 0, y < 0.

**Page directions.** In the page, away from the fold, the ground points along g = (0, sin alpha, cos alpha) and
the backdrop along b = (0, -sin alpha, cos alpha).

**Skew coordinates.** Whatever stays parallel to the pages and to z (all of step-fold and box-fold, the corners
of every base patch pair) is placed as x e_x + u d + v z, where d is g or b, according to its side. The numbers
(x, u, v) do not change while the card closes; only d turns.

Arrays are float64, checked and locked where they enter (:mod:`popsim.geometry.arrays`); functions of the fold
angle take theta of shape (n,) and return one row per angle.
"""
