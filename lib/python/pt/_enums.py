"""The numbers of the headers in lib/include/pt, by name: PT_QUANTITY_RADIANCE is Quantity.RADIANCE. tests/abi holds
them against the headers, so that one that is added there is added here."""

import enum
from typing import Final


class Result(enum.IntEnum):
    """What a call came to. Errors are raised (see Error), so that calls return one of the first four."""

    OK = 0
    CANCELLED = 1  # the caller asked to stop; whole samples were kept, or the scene before
    TARGET_REACHED = 2  # the target error was reached before all samples were taken
    PENDING = 3
    ERROR_INVALID_ARGUMENT = -1
    ERROR_INVALID_SCENE = -2
    ERROR_INVALID_STATE = -3
    ERROR_UNSUPPORTED = -4
    ERROR_NO_DEVICE = -5
    ERROR_OUT_OF_HOST_MEMORY = -6
    ERROR_OUT_OF_DEVICE_MEMORY = -7
    ERROR_DEVICE_LOST = -8
    ERROR_SHADER = -9
    ERROR_INTERNAL = -10
    ERROR_INCOMPATIBLE = -11


class Quantity(enum.IntEnum):
    """What is read of an image."""

    RADIANCE = 0  # mean of the samples: linear RGB, unclamped
    STANDARD_ERROR = 1  # of that mean; in a single pixel no more than a hint. Infinite up to 8 samples
    SAMPLE_COUNT = 2  # samples that the pixel has, the same in all channels
    DEPTH = 3  # along the view, of what the ray through the pixel's centre meets first; infinite where that is nothing
    NORMAL = 4  # of what camera rays meet first, the mean of 16
    ALBEDO = 5  # diffuse + specular of that, likewise
    OBJECT = 6  # index of the sphere, or of all spheres + that of the plane; NO_OBJECT. In Format.R32UI
    COVERAGE = 7  # share of the samples whose camera rays meet a surface


NO_OBJECT: Final = 0xFFFFFFFF  # of Quantity.OBJECT, where a ray meets nothing


class Format(enum.IntEnum):
    """What a pixel is; A is 1."""

    RGB32F = 0
    RGBA32F = 1
    RGBA16F = 2
    R32UI = 3  # a number for each pixel: of Quantity.OBJECT


class MaterialFlag(enum.IntFlag):
    """What else a material is."""

    HIDDEN_FROM_CAMERA = 1  # rays from the camera pass through


class Projection(enum.IntEnum):
    """What the rays of a camera have in common."""

    PERSPECTIVE = 0  # they start at one point
    ORTHOGRAPHIC = 1  # they are parallel, and start on a plane


class Estimator(enum.IntEnum):
    """How light is found. All converge to the same image, with different noise and time."""

    BEST = 0  # mis
    UNIFORM = 1
    COSINE = 2
    BSDF = 3
    LIGHT = 4
    MIS = 5


class Sampler(enum.IntEnum):
    """Where a sample's numbers come from. All converge to the same image, at other rates."""

    BEST = 0  # sobol
    RANDOM = 1
    HALTON = 2
    HALTON_CP = 3
    SOBOL = 4


class Sampling(enum.IntEnum):
    """Where samples go. All converge to the same image."""

    BEST = 0  # adaptive with a target error, else uniform
    UNIFORM = 1  # to all pixels alike
    ADAPTIVE = 2  # where they lessen the error most, which takes a target error


class ColumnType(enum.IntEnum):
    """What a component of a column is."""

    FLOAT32 = 1
    FLOAT64 = 2
    UINT32 = 3
    SRGB8 = 4


class LogLevel(enum.IntEnum):
    """Level of a log line."""

    ERROR = 1
    WARNING = 2
    INFO = 3


class CreateFlag(enum.IntFlag):
    """What else a context is to be; see Context."""

    VALIDATION = 1
    NO_SCENE_KERNELS = 2


class DeviceKind(enum.IntEnum):
    """What a Vulkan device is."""

    OTHER = 0
    INTEGRATED_GPU = 1
    DISCRETE_GPU = 2
    VIRTUAL_GPU = 3
    CPU = 4


class Feature(enum.IntFlag):
    """What the kernel contains because the scene needs it."""

    LAMPS = 1
    GLOSS = 2
    MOTION = 4
    LARGE = 8
    TREE = 16
    ORTHOGRAPHIC = 32
    HIDDEN = 64


class Uncertain(enum.IntFlag):
    """Why an error that is stated may be far off. Its bounds are then wider by a further factor of two."""

    RMSE = 1
    RELATIVE_RMSE = 2
    UNSEEN = 4
    UNMET = 8
