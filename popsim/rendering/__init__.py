"""Seeing a surface: orthographic maps for the patches, pictures for people.

:mod:`popsim.rendering.ray_scene` prepares a surface for rays (Embree finds the face, double precision says
where), :mod:`popsim.rendering.maps` looks at it through a :class:`popsim.rendering.view.View` (Sec. 4.3), and
:mod:`popsim.rendering.picture` through a :class:`popsim.rendering.camera.Camera`. Everything is in the frame
and unit of the surface. Images have row 0 at the top; colours are sRGB values, multiplied and averaged as
they are. Faces have two sides; what is less than half opaque is a hole.
"""
