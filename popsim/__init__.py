"""popsim turns a 3D model into a paper pop-up that provably folds.

The method is that of Ruiz, Le, Yu and Low, "Multi-style Paper Pop-up Designs from 3D Models" (2014), called
*the paper* in all docstrings; "Sec." and "Eq." cite it. The frame, the units and the names stand in
:mod:`popsim.geometry`.
"""

__version__ = "0.1.0"
