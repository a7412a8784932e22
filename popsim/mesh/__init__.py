"""From a model file to coloured triangles in a canonical frame (Sec. 4.1); the only room of trimesh.

:mod:`~popsim.mesh.loading` reads a file, :mod:`~popsim.mesh.sampling` spreads points over the surface, and
:mod:`~popsim.mesh.alignment` stands it upright over the central fold. Two frames occur:

model coordinates
    those of the file's scene, with its transforms applied, in its unit and with its own up axis;
canonical frame
    z up, the model on z = 0, the central fold along x in the mirror plane y = 0, the x range centred on 0.
    Right-handed, in the file's unit.
"""
