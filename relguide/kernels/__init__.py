"""Numbers in, numbers out: the compiled kernels. The files above give these numbers names."""

from relguide.kernels import apart as apart
from relguide.kernels import cache as cache
from relguide.kernels import compiling as compiling
from relguide.kernels import distinct_names as distinct_names
from relguide.kernels import loading as loading
from relguide.kernels import plain_types as plain_types
from relguide.kernels import shortcuts as shortcuts

cache.adopt()
