"""`python -m relguide.warm_up`."""

import sys

from relguide.warm_up import main

sys.exit(main())
