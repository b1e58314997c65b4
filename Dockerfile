# The server in a container, for Linux with a plotter on USB: docs/docker.md. It runs as a user without rights.
FROM node:22-bookworm-slim AS build
WORKDIR /plotwright
COPY package.json package-lock.json ./
RUN npm ci --ignore-scripts --no-audit --no-fund
COPY . .
RUN npm pack --pack-destination /tmp

FROM node:22-bookworm-slim
COPY --from=build /tmp/plotwright-*.tgz /tmp/
# mqtt is for `serve --mqtt`.
RUN npm install --global --no-audit --no-fund /tmp/plotwright-*.tgz mqtt@5 \
  && npm cache clean --force \
  && rm /tmp/plotwright-*.tgz \
  && install --directory --owner=node --group=node /data
ENV NODE_ENV=production XDG_DATA_HOME=/data XDG_CONFIG_HOME=/data
USER node
VOLUME /data
EXPOSE 9080
HEALTHCHECK --start-period=30s CMD ["plotwright", "queue"]
ENTRYPOINT ["plotwright"]
CMD ["serve", "--lan"]
