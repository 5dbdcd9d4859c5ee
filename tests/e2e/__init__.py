"""The project as its user meets it: headless Chromium against the real service."""
