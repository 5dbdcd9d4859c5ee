"""How much one person or address may ask for, and how often a stranger may try a token. Used with a login."""

from __future__ import annotations

import time

from limits import RateLimitItem, parse
from limits.storage import MemoryStorage
from limits.strategies import MovingWindowRateLimiter

from server.errors import ServiceError

TRIES = parse("20/minute")
"""Wrong tokens from one address: guessing one is hopeless anyway, but it shouldn't cost the others their robot."""


class Rates:
    """Counts requests over a moving window.

    each: what a person, and beside that an address, may ask for, e.g. `6000/minute`.
    """

    def __init__(self, each: str) -> None:
        self._each = parse(each)
        self._limiter = MovingWindowRateLimiter(MemoryStorage())

    def ask(self, kind: str, who: str) -> None:
        """Count a request.

        Raises:
            ServiceError: 429, with when to come again.
        """
        if not self._limiter.hit(self._each, kind, who):
            raise _too_often(self._limiter, self._each, kind, who)

    def must_be_patient(self, address: str) -> None:
        """Refuse an address that has tried too many wrong tokens.

        Raises:
            ServiceError: 429.
        """
        if not self._limiter.test(TRIES, "tries", address):
            raise _too_often(self._limiter, TRIES, "tries", address)

    def failed(self, address: str) -> None:
        """A wrong token came from there."""
        self._limiter.hit(TRIES, "tries", address)


def _too_often(limiter: MovingWindowRateLimiter, limit: RateLimitItem, kind: str, who: str) -> ServiceError:
    seconds = max(1, round(limiter.get_window_stats(limit, kind, who).reset_time - time.time()))
    return ServiceError(
        429,
        f"more than {limit.amount} requests in {limit.get_expiry()} s",
        remedy=f"wait {seconds} s, then try again; SEED_RATE_LIMIT sets the limit",
        headers={"Retry-After": str(seconds)},
    )
