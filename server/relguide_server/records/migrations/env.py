"""Run by alembic: applies revisions over the connection that it is given."""

from alembic import context

from relguide_server.records.schema import metadata

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=metadata,
    transactional_ddl=False,  # the transaction is begun and ended around all of it
)
context.run_migrations()
