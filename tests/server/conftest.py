"""Fixtures for tests of the server's parts."""

from tests.server.databases import postgres, sqlite_store, store, url

__all__ = ["postgres", "sqlite_store", "store", "url"]
