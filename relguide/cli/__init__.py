"""The command line, one file a command: `plan_command.py` is `relguide plan`, and so on.

Each has PURPOSE and EXAMPLES for the help, `add_options`, and `run`, which returns the exit status.
What a command needs beyond numpy and numba is loaded when it runs, so that `--help` answers at once
and works whatever is installed.

Shared: `shared_options` are options of more than one command, `situation_file` reads what is to be
planned, `output` writes; `plan_tables`, `flight_tables`, `branch_tables` and `template_tables` are
tables for people, made by `shared_tables`; `tree_growth` grows the paper's tree under a bar;
`workers` are the threads, or the Dask cluster, that make parts.
"""
