# The service in a container, rendering with software OpenGL. `make check-docker` runs these steps without an engine.
FROM debian:bookworm-slim AS build

# gcc and headers: evdev, which robosuite pulls in, has no wheel.
# hadolint ignore=DL3008
RUN apt-get update && \
    apt-get install -y --no-install-recommends ca-certificates gcc libc6-dev linux-libc-dev python3-dev python3-venv && \
    rm -rf /var/lib/apt/lists/*

RUN python3 -m venv /opt/seed
WORKDIR /src
ENV PIP_NO_CACHE_DIR=1

# What changes seldom comes first: the packages that the service stands on.
COPY pyproject.toml constraints.txt hatch_build.py README.md LICENSE ./
COPY scripts/install.sh scripts/node.py scripts/
COPY agent/__init__.py agent/
COPY robot_adapters/__init__.py robot_adapters/
COPY server/__init__.py server/
RUN bash scripts/install.sh /opt/seed && \
    /opt/seed/bin/pip uninstall --yes seed-robot

# The build hook builds the web page; a Node.js for it is there for just that time.
COPY . .
RUN /opt/seed/bin/pip install --no-deps .


FROM debian:bookworm-slim

# hadolint ignore=DL3008
RUN apt-get update && \
    apt-get install -y --no-install-recommends ca-certificates libegl1 libegl-mesa0 libgl1 libosmesa6 python3 && \
    rm -rf /var/lib/apt/lists/*
RUN useradd --create-home --user-group --uid 10001 seed && \
    install -d -o seed -g seed /data

COPY --from=build /opt/seed /opt/seed
# Others reach the port, so everybody is asked who they are: the log of the first start tells the owner's way in.
ENV PATH=/opt/seed/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    SEED_DATA_DIR=/data \
    SEED_HOST=0.0.0.0 \
    SEED_LOGIN=1 \
    SEED_PORT=8000
USER 10001
WORKDIR /home/seed
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=5s --start-period=30s --retries=3 \
    CMD ["python3", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/health', timeout=4)"]
CMD ["seed", "serve"]
