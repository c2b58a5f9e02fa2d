"""Quorum: multi-view stereo with one result on every device.

    scene = quorum.Scene.from_arrays(images, K, R, t)    # or quorum.Scene.read("folder")
    results = quorum.reconstruct(scene, neighbors=6)
    depth = results.depth_map(0).depth                   # (height, width) float32, scene units; 0 = none
    mesh = results.mesh()                                # mesh.vertices, mesh.faces, mesh.colors ...

Options are those of the program `quorum reconstruct`, as keyword arguments with _ for -; quorum.options() lists them.
Failures are quorum.Error. docs/python.md tells more.
"""

from ._quorum import (
    DepthMap,
    Device,
    Mesh,
    OptionInfo,
    Progress,
    Results,
    Scene,
    View,
    __version__,
    choose_device,
    devices,
    options,
    reconstruct,
)
from .errors import Error, ErrorKind

__all__ = [
    "DepthMap",
    "Device",
    "Error",
    "ErrorKind",
    "Mesh",
    "OptionInfo",
    "Progress",
    "Results",
    "Scene",
    "View",
    "choose_device",
    "devices",
    "options",
    "reconstruct",
]
