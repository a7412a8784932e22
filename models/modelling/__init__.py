"""Shapes, painted atlases and file writers from which the models of this folder are made.

A model is a set of triangles, each painted by the orthographic picture of the side that it faces. Lengths are in
model units; right-handed frames.
"""
