"""HTTP routes, one file a resource, and what they share: the service, identifiers, pages and documented errors."""
