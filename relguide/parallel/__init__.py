"""Work in chunks, done by many: this machine's processes or threads, or a Dask cluster.

`in_order.py` has chunks done and gives them in order, `pool.py` owns the processes and threads,
`cluster.py` connects to Dask, `program.py` tells one version of the program from another.
"""
