// SPDX-License-Identifier: GPL-3.0-or-later
#include "scrolling_dialogs.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>

namespace {

constexpr double k_share_of_screen = 0.8;  // leaves room for the title, and to see that there is more of MeshLab

/// Puts what the dialog shows into a scroll area, unless it has room or is in one already.
void make_scroll(QDockWidget& dialog)
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

/// Words that wrap take more lines than MeshLab reckons with, and its buttons then lie on the last row.
void make_room(QDockWidget& dialog)
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
    if (qApp)  // none in Python, where this plugin does not belong: PyMeshLab refuses it once it is made
        qApp->installEventFilter(this);
}

bool ScrollingDialogs::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Show || event->type() == QEvent::LayoutRequest)
        if (auto* const dialog = qobject_cast<QDockWidget*>(watched);
            dialog && dialog->windowTitle().startsWith(title_)) {
            make_scroll(*dialog);
            make_room(*dialog);
        }
    return QObject::eventFilter(watched, event);
}
