"""Studies: algorithms x tasks x seeds without a browser, ending in curves, tables and figures (paper, 'Results').

Planning, reading, statistics and figures import no torch; only `runs` and what it calls do, in processes of their own.
"""
