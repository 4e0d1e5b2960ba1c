"""The numbers of the headers in lib/include/pt, by name, as lib/python/generate.py writes them: PT_QUANTITY_RADIANCE
is Quantity.RADIANCE."""

import enum
from typing import Final

NO_OBJECT: Final = 0xFFFFFFFF  # of Quantity.OBJECT, where a ray meets nothing


class Quantity(enum.IntEnum):
    """What is read of an image."""

    RADIANCE = 0  # mean of the samples
    STANDARD_ERROR = 1
    SAMPLE_COUNT = 2  # the pixel's samples, rounded to float32, the same in all channels
    DEPTH = 3  # depth along the viewing direction
    NORMAL = 4  # unit normal in world coordinates, on the side of the camera
    ALBEDO = 5  # diffuse + specular, each component at most 1
    OBJECT = 6  # index of the surface of PT_QUANTITY_DEPTH
    COVERAGE = 7  # share of the pixel's samples whose camera rays meet a surface, the same in all channels


class Format(enum.IntEnum):
    """What a pixel is; A is 1."""

    RGB32F = 0  # R, G, B as float32
    RGBA32F = 1  # R, G, B, A as float32
    RGBA16F = 2  # R, G, B, A as float16
    R32UI = 3  # one uint32_t


class MaterialFlag(enum.IntFlag):
    """What else a material is."""

    HIDDEN_FROM_CAMERA = 1  # Camera rays pass through surfaces of the material


class Projection(enum.IntEnum):
    """What the rays of a camera have in common."""

    PERSPECTIVE = 0  # a pinhole
    ORTHOGRAPHIC = 1


class Estimator(enum.IntEnum):
    """How light is found. All converge to the same image, with different noise and time."""

    BEST = 0  # what this version considers best
    UNIFORM = 1  # directions uniform on the hemisphere
    COSINE = 2  # directions in proportion to the cosine to the normal
    BSDF = 3  # directions by the material, cosine and specular lobe
    LIGHT = 4  # lamps sampled by solid angle
    MIS = 5  # lamps sampled by solid angle and directions as bsdf, combined by weights


class Sampler(enum.IntEnum):
    """Where a sample's numbers come from. All converge to the same image, at other rates."""

    BEST = 0  # what this version considers best
    RANDOM = 1  # independent random numbers
    HALTON = 2  # radical inverses in prime bases, the same points in every pixel
    HALTON_CP = 3  # the same, rotated by a random offset per pixel and dimension (Cranley, Patterson)
    SOBOL = 4  # Sobol points, Owen-scrambled per pixel and dimension


class Sampling(enum.IntEnum):
    """Where samples go. All converge to the same image."""

    BEST = 0  # adaptive with a target error, else uniform
    UNIFORM = 1  # to all pixels alike
    ADAPTIVE = 2  # where they reduce the error most


class ColumnType(enum.IntEnum):
    """What a component of a column is."""

    FLOAT32 = 1  # float
    FLOAT64 = 2  # double
    UINT32 = 3  # uint32_t
    SRGB8 = 4  # uint8_t, for colors only


class LogLevel(enum.IntEnum):
    """Level of a log line."""

    ERROR = 1  # something is wrong
    WARNING = 2  # something may be wrong
    INFO = 3  # devices, the kernels that drivers build, and how long that takes


class CreateFlag(enum.IntFlag):
    """What else a context is to be; see Context."""

    VALIDATION = 1  # the Khronos validation layer reports to log
    NO_SCENE_KERNELS = 2  # No kernels with a scene's numbers as constants, so nothing is built when the camera moves


class DeviceKind(enum.IntEnum):
    """What a Vulkan device is."""

    OTHER = 0  # none of the others
    INTEGRATED_GPU = 1  # shares the memory of the machine
    DISCRETE_GPU = 2  # has memory of its own
    VIRTUAL_GPU = 3  # a virtual machine's
    CPU = 4  # a driver that runs kernels on the CPU


class Feature(enum.IntFlag):
    """What the kernel contains because the scene needs it."""

    LAMPS = 1  # emitting spheres, sampled directly
    GLOSS = 2  # specular lobes
    MOTION = 4  # spheres that move while the shutter is open
    LARGE = 8  # more surfaces than a uniform buffer holds, or a tree
    TREE = 16  # 113 spheres or more
    ORTHOGRAPHIC = 32  # parallel camera rays
    HIDDEN = 64  # surfaces that the camera does not see
    LENS = 128  # camera rays start on a lens
    CAPSULES = 256  # some spheres are swept along a segment
    OPACITY = 512  # rays pass some spheres at random


class Light(enum.IntEnum):
    """What a comparison of two images comes to."""

    EQUAL_BITS = 1  # all numbers are equal
    SAME = 2  # no difference beyond noise, and min_change would have been found
    DIFFERENT = 3  # the light differs in some region
    UNDECIDED = 4  # no difference beyond noise, but a change of min_change may have been missed


class Uncertain(enum.IntFlag):
    """Why an error that is stated may be far off. Its bounds are then wider by a further factor of two."""

    RMSE = 1  # rmse comes from fewer than 4 pixels
    RELATIVE_RMSE = 2
    UNSEEN = 4
    UNMET = 8


class Result(enum.IntEnum):
    """What a call came to. Errors are raised (see Error), so that calls return one of the first four."""

    OK = 0  # done
    CANCELLED = 1  # the caller asked to stop
    TARGET_REACHED = 2  # the target error was reached before all samples were taken
    PENDING = 3  # samples are under way, see pt/async.h
    ERROR_INVALID_ARGUMENT = -1  # a field, size or pointer breaks a rule of this header
    ERROR_INVALID_SCENE = -2  # a scene breaks a rule
    ERROR_INVALID_STATE = -3  # something must be set or end first, or another call is under way
    ERROR_UNSUPPORTED = -4  # valid, but beyond this device, driver or library
    ERROR_NO_DEVICE = -5  # no Vulkan driver, or no device fits
    ERROR_OUT_OF_HOST_MEMORY = -6  # the machine has too little memory left
    ERROR_OUT_OF_DEVICE_MEMORY = -7  # the device has too little memory left, for this image for instance
    ERROR_DEVICE_LOST = -8  # the device or its driver gave up
    ERROR_SHADER = -9  # the driver refused to build the kernel, or its GLSL does not compile
    ERROR_INTERNAL = -10  # a bug in this library or in the driver
    ERROR_INCOMPATIBLE = -11  # bytes that are no film of this picture (pt/film.h)
