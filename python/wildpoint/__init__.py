"""Find and repair *wild points*: samples of a tracking record that the target cannot have produced.

>>> import numpy as np, wildpoint
>>> t = np.arange(200) * 0.1
>>> y = 300 * np.sin(t / 3) + np.random.default_rng(1).normal(size=200)
>>> y[100] += 40
>>> found = wildpoint.detect(y, t)
>>> np.flatnonzero(found.outlier)
array([100])

``detect`` judges one channel in arrays, ``clean`` the channels of a table (pandas, polars, pyarrow or whatever else hands
over Arrow), by settings or by a session that was saved in the workbench. ``methods`` lists the methods, ``advise`` says
which of them to take. The workbench is the program ``wildpoint``, which is installed with this package.
"""

from ._detection import Detection, Verdict, detect
from ._methods import Advice, Method, Parameter, advise, methods
from ._session import Session
from ._tables import clean
from ._wildpoint import Error, __version__

__all__ = [
    "Advice",
    "Detection",
    "Error",
    "Method",
    "Parameter",
    "Session",
    "Verdict",
    "__version__",
    "advise",
    "clean",
    "detect",
    "methods",
]
