"""Alembic migrations, run by `server.store_upgrade` on a connection that it hands over."""
