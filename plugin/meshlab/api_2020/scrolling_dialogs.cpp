// SPDX-License-Identifier: GPL-3.0-or-later
#include "scrolling_dialogs.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>

namespace {

constexpr double k_share_of_screen = 0.8;  // of its height; leaves space for the title and MeshLab's window

/// Puts the content into a scroll area, unless it fits the screen or is in one already.
void add_scroll_area(QDockWidget& dialog)
{
    QWidget* const content = dialog.widget();
    const int highest = int(k_share_of_screen * dialog.screen()->availableGeometry().height());
    if (!content || qobject_cast<QScrollArea*>(content) || content->sizeHint().height() <= highest)
        return;
    auto* const area = new QScrollArea(&dialog);
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    dialog.setWidget(area);  // hides the content
    area->setWidget(content);
    content->show();
    QObject::connect(content, &QObject::destroyed, area, &QObject::deleteLater);  // MeshLab deletes what it made

    const QSize size(content->sizeHint().width() + area->verticalScrollBar()->sizeHint().width(), highest);
    area->setMinimumSize(size);
    dialog.setMinimumSize(size);
    dialog.adjustSize();
}

/// Enlarges a dialog whose labels wrap: MeshLab does not count these lines and puts its buttons on the last row.
void add_missing_height(QDockWidget& dialog)
{
    const QWidget* const content = dialog.widget();
    if (!content || !content->hasHeightForWidth())
        return;
    const int missing = content->heightForWidth(content->width()) - content->height();
    if (missing > 0)
        dialog.resize(dialog.width(), dialog.height() + missing);
}

}  // namespace

ScrollingDialogs::ScrollingDialogs(const QString& title, QObject* parent) : QObject(parent), title_(title)
{
    if (qApp)  // null in PyMeshLab, which constructs the plugin before it refuses the version
        qApp->installEventFilter(this);
}

bool ScrollingDialogs::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Show || event->type() == QEvent::LayoutRequest)
        if (auto* const dialog = qobject_cast<QDockWidget*>(watched);
            dialog && dialog->windowTitle().startsWith(title_)) {
            add_scroll_area(*dialog);
            add_missing_height(*dialog);
        }
    return QObject::eventFilter(watched, event);
}
