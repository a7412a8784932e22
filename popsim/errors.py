"""All errors that popsim raises on purpose.

Every message says what was found, what was expected and what to do. The command line prints it on one line
and exits with code 2.
"""


class PopsimError(Exception):
    """Base of all errors of popsim."""


class InputError(PopsimError, ValueError):
    """An argument, an option or a file of the user cannot be used."""


class MeshError(InputError):
    """A 3D model cannot be read, or holds nothing to make a pop-up of."""


class DesignError(InputError):
    """A design breaks a rule of the format; the message names the field."""


class GeometryError(InputError):
    """Points, polygons or transforms that break a rule of :mod:`popsim.geometry`."""


class OutputError(PopsimError, OSError):
    """A file or folder cannot be written."""


class PopsimWarning(UserWarning):
    """Something was degraded; the same words stand in the report."""
