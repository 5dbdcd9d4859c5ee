"""Tests mirror the tree; e2e/ is the browser, benchmarks/ prints ratios."""
